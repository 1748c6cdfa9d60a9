// The mean radiance in the cells of a layer, in discrete directions, where the light that each cell
// scatters is known (discrete ordinates: Chandrasekhar 1960; step characteristics: Lathrop 1969).
//
// All rays of one direction cross the layer together, plane by plane. A plane is crossed in steps
// in which rays move by at most a cell along x and y. Between the middles of two steps light is
// interpolated linearly between rays; in a step of the optical depth x in a cell that sends out S
//
//   after = S + (L - S) exp(-x)        mean = S + (L - S) (1 - exp(-x)) / x
//
// The zenith cosines of each hemisphere are Gauss and Legendre's, and azimuths are even steps, so that
// integrals of harmonics times harmonics up to kMostDegree are exact. The azimuths of every second
// zenith cosine lie between those of the others, because light between small clouds shows in which
// directions it was followed (ray effects: Lathrop 1968).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/memory.h"
#include "bakers/math/parallel.h"

namespace skybake::cloud_light {

// Values in the cells of a layer, one field for each coefficient of harmonics: [coefficient][z][y][x].
// Rows are followed by kRowSlack floats.
class CellFields {
  public:
    CellFields() = default;
    CellFields(const std::array<int, 3>& size, std::size_t count);

    std::size_t count() const { return count_; }
    const std::array<int, 3>& size() const { return size_; }
    void clear() { std::ranges::fill(values_, 0.0F); }
    float* row(std::size_t field, int z, int y) { return values_.data() + at(field, z, y); }
    const float* row(std::size_t field, int z, int y) const {
        return values_.data() + at(field, z, y);
    }

  private:
    std::size_t at(std::size_t field, int z, int y) const;

    std::array<int, 3> size_{};
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
    AlignedFloats values_;
};

// Returns the values of one field, x fastest.
std::vector<float> values_of(const CellFields& fields, std::size_t field);

// Calls use(z) for all planes at once.
template <class Use>
void for_each_plane(const CellFields& fields, const BakeOptions& options, const Use& use) {
    parallel_for(fields.size()[2], options.threads, use);
}

// Calls use(c, y) for the rows of a plane.
template <class Use>
void for_each_row(const CellFields& fields, const Use& use) {
    for (std::size_t c = 0; c < fields.count(); ++c) {
        for (int y = 0; y < fields.size()[1]; ++y) use(c, y);
    }
}

// The cells of a layer: extinction in 1/m of a single field, and edges in metres.
struct LayerCells {
    CellFields extinction;
    std::array<double, 3> edge_m{};
};

// Light that enters the layer from all directions above and below.
struct EnteringLight {
    double sky = 0;
    double ground = 0;
    std::vector<double> sky_shape = {};  // factors of sky, one for each ordinate; empty: all 1
};

class RadianceSweep {
  public:
    RadianceSweep(const LayerCells& cells, int degree, int threads);

    // Writes the coefficients of the mean radiance in each cell. `sources` are those of the light per
    // extinction that cells send out. They are incomplete once options.progress is cancelled.
    void find_radiance(const CellFields& sources, const EnteringLight& entering,
                       CellFields& radiance, const BakeOptions& options) const;

    // The share of what a cell sends out, in all directions alike, that its own mean radiance lacks.
    const CellFields& leaving() const { return leaving_; }

    // The directions in which the sky is seen from which rays come, in the order of
    // EnteringLight::sky_shape.
    std::vector<SkyDirection> sky_ordinates() const;

  private:
    struct Ordinate {
        glm::dvec3 direction{};
        double solid_angle = 0;
        std::size_t node = 0;  // of the zenith angle
    };
    struct Rays;

    void fill_passing(const LayerCells& cells, std::size_t node, double cosine,
                      double share_of_sphere, int threads);
    void sweep(const CellFields& sources, const std::vector<double>& entering, bool rises,
               CellFields& sums, const BakeOptions& options) const;
    void send_out_row(const CellFields& sources, int z, int y, std::vector<Rays>& rays) const;
    void cross_plane(int z, Rays& rays) const;
    void step(const Ordinate& ordinate, int z, int y, Rays& rays) const;
    void gather_row(const std::vector<Rays>& rays, int z, int y, CellFields& sums) const;

    std::array<int, 3> size_;
    std::array<double, 3> edge_m_;
    std::size_t coefficients_;
    std::vector<int> steps_;          // across a plane, of each node
    std::vector<Ordinate> downward_;  // of the lower hemisphere
    CellFields passing_;              // one field for each node
    CellFields mean_passing_;
    CellFields leaving_;
};

}  // namespace skybake::cloud_light
