#include "bakers/assets/cloud_light/cloud_light_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/assets/description/asset_label.h"
#include "bakers/field/baked.h"
#include "bakers/field/block_voxels.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/survey_volume.h"
#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

using cloud_light::CloudLayer;
using cloud_light::LightChannels;

// Places that are as dense as the cloud is: where a march adds light, there errors count.
class PlacesInCloud {
  public:
    explicit PlacesInCloud(const CloudLayer& layer) : layer_(layer) {
        double sum = 0;
        for (int row = 0; row < layer.size[1] * layer.size[2]; ++row) {
            for (int x = 0; x < layer.size[0]; ++x) sum += density_at(x, row);
            until_row_.push_back(sum);
        }
    }

    // Moves points that are even in the unit cube. Without cloud they stay.
    std::array<double, 3> operator()(const std::array<double, 3>& uvw) const {
        double left = uvw[0] * until_row_.back();
        const auto found = std::ranges::upper_bound(until_row_, left);
        if (found == until_row_.end()) return uvw;
        const auto row = static_cast<int>(found - until_row_.begin());
        if (row > 0) left -= *std::prev(found);
        int x = 0;
        double density = density_at(x, row);
        while (left >= density && x + 1 < layer_.size[0]) {
            left -= density;
            density = density_at(++x, row);
        }
        const double across = std::min(left / density, 1.0);
        return {(x + across) / layer_.size[0], (row % layer_.size[1] + uvw[1]) / layer_.size[1],
                (row / layer_.size[1] + uvw[2]) / layer_.size[2]};
    }

  private:
    // The density of a voxel of a row; rows are counted through all heights.
    double density_at(int x, int row) const {
        return density(layer_.optics, double{layer_.value(x, row, 0)});
    }

    const CloudLayer& layer_;
    std::vector<double> until_row_;  // the sum of all densities of this row and those before it
};

using Values = std::vector<double>;

// Errors are differences of what is shown, as shares of `scale`.
template <class Shown>
void compare_by(double scale, const Shown& shown, VolumeComparison& comparison) {
    comparison.errors = [=](const std::array<double, 3>&, const Values& found,
                            const Values& wanted) {
        Values errors;
        for (std::size_t c = 0; c < found.size(); ++c) {
            errors.push_back((shown(found[c]) - shown(wanted[c])) / scale);
        }
        return errors;
    };
}

constexpr auto kItself = [](double value) { return value; };

// Where there is little cloud, little light is scattered, and its range is small beside the light that a
// runtime adds to it. So errors are shares of the source's own light.
CloudLightTruth radiance_truth(const CloudLayer& layer, const CloudLightBake& bake, int threads) {
    CloudLightTruth truth;
    truth.reference = cloud_light::radiance_reference(layer, bake, threads);
    truth.name =
        fmt::format("up to {} paths of light from each point", cloud_light::kReferencePaths);
    truth.comparison.scale = "coefficient 0 of the source's light at a point that no cloud shades";
    const double scale = cloud_light::unshaded_coefficient(bake);
    compare_by(scale, kItself, truth.comparison);
    truth.comparison.noise = [scale](const Values& wanted) {
        Values noise(wanted.begin() + static_cast<std::ptrdiff_t>(wanted.size() / 2), wanted.end());
        for (double& error : noise) error /= scale;
        return noise;
    };
    return truth;
}

// Returns coefficient 0 of harmonics of transmittances where nothing shades.
double unshaded_transmittance(CloudLightBake bake) {
    bake.part = 1;
    double sum = 0;
    for (const Values& weights : cloud_light::light_channels(bake).weights) sum += weights[0];
    return sum;
}

// Depths count as the sunlight that they leave. A series of depths shows in no one direction, so that its
// coefficients are compared as such.
VolumeComparison comparison_of_depths(const CloudLightBake& bake) {
    VolumeComparison comparison;
    if (config::is_depth(bake.contents)) {
        comparison.scale = "sunlight that no cloud shades; depths are compared as exp(-depth)";
        compare_by(
            1, [](double depth) { return exponential(-depth); }, comparison);
    } else if (bake.contents == CloudLightContents::transmittance) {
        comparison.scale = "sunlight that no cloud shades";
        compare_by(1, kItself, comparison);
    } else if (bake.contents != CloudLightContents::optical_depth_harmonics) {
        comparison.scale = "coefficient 0 where no cloud shades";
        compare_by(unshaded_transmittance(bake), kItself, comparison);
    }
    return comparison;
}

CloudLightTruth truth_of_depths(const CloudLayer& layer, const CloudLightBake& bake) {
    CloudLightTruth truth;
    truth.comparison = comparison_of_depths(bake);
    const bool is_map = bake.contents == CloudLightContents::shadow;
    const auto channels = std::make_shared<const LightChannels>(
        cloud_light::light_channels(bake, cloud_light::kReferenceDirections));
    truth.reference = [&layer, channels, is_map](const std::array<double, 3>& uvw) {
        const double z = is_map ? 0 : uvw[2] * layer.size[2];
        return cloud_light::light_reference(
            layer, {uvw[0] * layer.size[0], uvw[1] * layer.size[1], z}, *channels);
    };
    truth.name = config::is_per_sun(bake.contents)
                     ? "the integral along each ray through the filtered volume"
                     : "integrals along rays through the filtered volume in 128 directions";
    return truth;
}

using Uvw = std::array<double, 3>;

// The true values at the places of all lookups, which do not depend on the cell.
class KnownTruth {
  public:
    KnownTruth(CloudLightTruth truth, int points, const BakeOptions& options)
        : truth_(std::move(truth)) {
        std::vector<std::pair<Uvw, std::vector<double>>> found(static_cast<std::size_t>(points));
        for_each_tile(points, options, "certify", [&](int i) {
            const Uvw point = low_discrepancy_point(i);
            const auto& move = truth_.comparison.lookup_place;
            const Uvw place = move ? move(point) : point;
            found[static_cast<std::size_t>(i)] = {place, truth_.reference(place)};
        });
        known_.insert(found.begin(), found.end());
    }

    // A texture of one texel along an axis is looked up at other places.
    std::vector<double> operator()(const Uvw& place) const {
        const auto known = known_.find(place);
        return known != known_.end() ? known->second : truth_.reference(place);
    }
    const VolumeComparison& comparison() const { return truth_.comparison; }

  private:
    CloudLightTruth truth_;
    std::map<Uvw, std::vector<double>> known_;
};

class CellSearch {
  public:
    CellSearch(const CloudLayer& layer, const CloudLightBake& bake, const BakeOptions& options)
        : layer_(layer),
          bake_(bake),
          options_(options),
          quick_points_(quick_lookup_points(is_expensive())),
          points_(std::max(quick_points_, kFewestPoints)),
          truth_(cloud_light_truth(layer, bake, options.threads), points_, options) {}

    Outcome<int> run(const std::string& name) {
        int best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (int cell = most_cell(); cell > 0; --cell) {
            const Outcome<double> error = error_of(cell);
            if (!error.value || options_.cancelled()) return {{}, error.diagnostics};
            if (*error.value <= *bake_.max_error) return {cell, {}};
            if (*error.value < least) best = cell;
            least = std::min(least, *error.value);
        }
        return diagnosis(
            "E0403",
            fmt::format(
                "`{}`: no cell meets max_error = {:.3g}; the best, {}, has an RMS error of {:.3g}",
                name, *bake_.max_error, best, least),
            "use a larger max_error or pixel_type = \"float\"", "max_error");
    }

  private:
    static constexpr int kFewestPoints = 256;

    // One texel along an axis is looked up at its centre alone, which says nothing of other places. So
    // cells leave two texels along each axis that has as many voxels.
    int most_cell() const {
        const bool is_map = bake_.contents == CloudLightContents::shadow;
        int most = config::most_cloud_light_cell;
        for (std::size_t a = 0; a < (is_map ? 2 : 3); ++a) {
            if (layer_.size[a] > 1) most = std::min(most, layer_.size[a] - 1);
        }
        return most;
    }

    bool is_expensive() const { return !config::is_per_sun(bake_.contents); }

    // Returns the texels of a cell, as files hold them, and no levels after an interruption.
    Baked texels_of(int cell) {
        CloudLightBake bake = bake_;
        bake.cell = cell;
        Baked volume;
        volume.channel_names = names_of_channels(config::channels_of(bake));
        volume.pixel_type = bake.pixel_type;
        const int spacing = cloud_light_spacing(bake);
        if (spacing != spacing_) {
            values_ = cloud_light_values(layer_, bake, spacing, options_, volume.details);
        }
        spacing_ = spacing;
        if (options_.cancelled()) return volume;
        Level level;
        level.size = cloud_light_size(layer_.size, bake);
        level.repeats = {true, true, false};
        level.voxels = fitted_texels(values_, level.size, bake, options_);
        volume.levels.push_back(std::move(level));
        code_levels(volume);
        return volume;
    }

    Outcome<double> error_of(int cell) {
        Baked volume = texels_of(cell);
        if (volume.levels.empty()) return {};
        const std::vector<std::array<double, 2>> ranges(volume.channel_names.size(), {0, 1});
        std::vector<Diagnostic> problems = survey_level(volume, 0, ranges, options_);
        if (!problems.empty() || options_.cancelled()) return {{}, std::move(problems)};
        const auto measured = [&](int points) {
            return measure_lookups(volume.levels[0], volume.pixel_type, std::cref(truth_), points,
                                   options_, truth_.comparison())
                .figures.rms;
        };
        return {std::max(measured(quick_points_), measured(points_)), {}};
    }

    const CloudLayer& layer_;
    const CloudLightBake& bake_;
    const BakeOptions& options_;
    const int quick_points_;
    const int points_;
    const KnownTruth truth_;
    int spacing_ = 0;
    SpacedValues values_;
};

}  // namespace

CloudLightTruth cloud_light_truth(const CloudLayer& layer, const CloudLightBake& bake,
                                  int threads) {
    CloudLightTruth truth = config::is_radiance(bake.contents)
                                ? radiance_truth(layer, bake, threads)
                                : truth_of_depths(layer, bake);
    if (bake.contents == CloudLightContents::shadow) return truth;
    truth.name += ", at places that are as dense as the cloud";
    truth.comparison.lookup_place = PlacesInCloud(layer);
    return truth;
}

Outcome<int> largest_cell(const CloudLayer& layer, const CloudLightBake& bake,
                          const std::string& name, const BakeOptions& options) {
    return CellSearch(layer, bake, options).run(name);
}

}  // namespace skybake
