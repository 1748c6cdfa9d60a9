#include "bakers/assets/cloud_light/radiance_solver.h"

#include <cmath>
#include <deque>
#include <numeric>
#include <utility>

#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::cloud_light {
namespace {

constexpr std::size_t kRemembered = 2;

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

double inner_product(const CellFields& a, const CellFields& b, const BakeOptions& options) {
    std::vector<double> sums(static_cast<std::size_t>(a.size()[2]));
    for_each_plane(a, options, [&](int z) {
        double sum = 0;
        for_each_row(a, [&](std::size_t c, int y) {
            const float* of_a = a.row(c, z, y);
            const float* of_b = b.row(c, z, y);
            for (int x = 0; x < a.size()[0]; ++x) sum += double{of_a[x]} * double{of_b[x]};
        });
        sums[static_cast<std::size_t>(z)] = sum;
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

// to += weight * from.
void add(const CellFields& from, double weight, CellFields& to, const BakeOptions& options) {
    for_each_plane(to, options, [&](int z) {
        for_each_row(to, [&](std::size_t c, int y) {
            const float* in = from.row(c, z, y);
            float* out = to.row(c, z, y);
            for (int x = 0; x < to.size()[0]; ++x) out[x] += static_cast<float>(weight) * in[x];
        });
    });
}

// The filter's taps at `points` even places of each cell of an axis.
std::vector<occupancy::AxisTaps> taps_along(const CloudLayer& layer, const PlaceGrid& places,
                                            std::size_t axis, int points) {
    std::vector<occupancy::AxisTaps> taps;
    for (int cell = 0; cell < places.count[axis]; ++cell) {
        for (int i = 0; i < points; ++i) {
            const double at = (cell + (i + 0.5) / points) * layer.size[axis] / places.count[axis];
            taps.push_back(occupancy::filter_taps(config::OccupancyFilter::trilinear, at,
                                                  layer.size[axis], axis < 2));
        }
    }
    return taps;
}

// Means over the cells, of as many filtered values as a cell has voxels.
LayerCells mean_cells(const CloudLayer& layer, const PlaceGrid& places, double share,
                      const BakeOptions& options) {
    LayerCells cells{CellFields(places.count, 1), {}};
    std::array<int, 3> points{};
    std::array<std::vector<occupancy::AxisTaps>, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        cells.edge_m[a] = layer.voxel_m[a] * layer.size[a] / places.count[a];
        points[a] = (layer.size[a] + places.count[a] - 1) / places.count[a];
        taps[a] = taps_along(layer, places, a, points[a]);
    }
    const auto voxel = [&](int x, int y, int z) { return layer.value(x, y, z); };
    const auto mean = [&](const std::array<int, 3>& cell) {
        double sum = 0;
        std::array<int, 3> i{};
        const auto tap = [&](std::size_t a) {
            return taps[a][static_cast<std::size_t>(cell[a] * points[a] + i[a])];
        };
        for (i[2] = 0; i[2] < points[2]; ++i[2]) {
            for (i[1] = 0; i[1] < points[1]; ++i[1]) {
                for (i[0] = 0; i[0] < points[0]; ++i[0]) {
                    const double value =
                        occupancy::filtered_in_double({tap(0), tap(1), tap(2)}, voxel);
                    sum += layer.optics.extinction_per_m * density(layer.optics, value);
                }
            }
        }
        return share * sum / (points[0] * points[1] * points[2]);
    };
    for_each_plane(cells.extinction, options, [&](int z) {
        for (int y = 0; y < places.count[1]; ++y) {
            float* row = cells.extinction.row(0, z, y);
            for (int x = 0; x < places.count[0]; ++x) row[x] = static_cast<float>(mean({x, y, z}));
        }
    });
    return cells;
}

// J_1, from exact depths towards the sun.
CellFields first_scattering(const PlaceGrid& places, const ScaledScattering& scattering,
                            const LayerSources& sources, const std::vector<float>& depths,
                            const BakeOptions& options) {
    const std::size_t coefficients = scattering.returned.size() * scattering.returned.size();
    CellFields first(places.count, coefficients);
    if (depths.empty()) return first;
    const Harmonics towards_eye = harmonics(-sources.sun_direction);
    for_each_plane(first, options, [&](int z) {
        for_each_row(first, [&](std::size_t c, int y) {
            const double scale =
                sources.sun * scattering.returned[degree_of_harmonic(c)] * towards_eye[c];
            const float* depth = depths.data() + occupancy::index_of(places.count, 0, y, z);
            float* row = first.row(c, z, y);
            for (int x = 0; x < places.count[0]; ++x) {
                row[x] = static_cast<float>(
                    scale * exponential(-scattering.extinction_share * double{depth[x]}));
            }
        });
    });
    return first;
}

// A guess and how the next order differs from it.
struct Guess {
    CellFields light;
    CellFields change;
};

// Anderson's next guess: light + change of the combination of guesses, whose weights add up to 1, that
// has the least change.
class AndersonGuesses {
  public:
    explicit AndersonGuesses(const BakeOptions& options) : options_(options) {}

    CellFields next(Guess guess) {
        guesses_.push_front(std::move(guess));
        products_.push_front({});
        for (std::size_t i = 0; i < guesses_.size(); ++i) {
            products_[i].push_front(0);
            if (i > 0) products_[0].push_back(0);
        }
        for (std::size_t i = 0; i < guesses_.size(); ++i) {
            const double product = inner_product(guesses_[0].change, guesses_[i].change, options_);
            products_[0][i] = product;
            products_[i][0] = product;
        }
        const std::vector<double> weights = least_change();
        CellFields light(guesses_[0].light.size(), guesses_[0].light.count());
        for (std::size_t i = 0; i < guesses_.size(); ++i) {
            add(guesses_[i].light, weights[i], light, options_);
            add(guesses_[i].change, weights[i], light, options_);
        }
        if (guesses_.size() > kRemembered) {
            guesses_.pop_back();
            products_.pop_back();
            for (auto& row : products_) row.pop_back();
        }
        return light;
    }

  private:
    // Solves P w = 1 and divides by the sum. A small share of the diagonal keeps P regular.
    std::vector<double> least_change() const {
        constexpr double kRegular = 1e-10;
        const std::size_t count = guesses_.size();
        std::vector<std::vector<double>> rows(count);
        for (std::size_t i = 0; i < count; ++i) {
            rows[i].assign(products_[i].begin(), products_[i].end());
            rows[i][i] *= 1 + kRegular;
            rows[i].push_back(1);
        }
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t i = 0; i < count; ++i) {
                if (i == p || rows[p][p] == 0) continue;
                const double factor = rows[i][p] / rows[p][p];
                for (std::size_t k = p; k <= count; ++k) rows[i][k] -= factor * rows[p][k];
            }
        }
        std::vector<double> weights(count);
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            weights[i] = rows[i][i] == 0 ? 0 : rows[i][count] / rows[i][i];
            sum += weights[i];
        }
        if (!(sum > 0)) return first_alone(count);
        for (double& weight : weights) weight /= sum;
        return weights;
    }
    static std::vector<double> first_alone(std::size_t count) {
        std::vector<double> weights(count, 0.0);
        weights[0] = 1;
        return weights;
    }

    const BakeOptions& options_;
    std::deque<Guess> guesses_;
    std::deque<std::deque<double>> products_;
};

// Returns the radiance that J and J_1 emit together, scattered once more in the cells.
CellFields scattered_again(const CellFields& light, const CellFields& first,
                           const RadianceSweep& sweep, const ScaledScattering& scattering,
                           const EnteringLight& entering, const BakeOptions& options) {
    CellFields sources = light;
    add(first, 1, sources, options);
    CellFields result = sweep.radiance(sources, entering);
    for_each_plane(result, options, [&](int z) {
        for_each_row(result, [&](std::size_t c, int y) {
            const auto returned = static_cast<float>(scattering.returned[degree_of_harmonic(c)]);
            float* row = result.row(c, z, y);
            for (int x = 0; x < result.size()[0]; ++x) row[x] *= returned;
        });
    });
    return result;
}

}  // namespace

RadianceSolver::RadianceSolver(const CloudLayer& layer, const PlaceGrid& places,
                               const CloudScattering& scattering, int degree,
                               const BakeOptions& options)
    : layer_(layer),
      places_(places),
      degree_(degree),
      scaled_(scaled(scattering, degree)),
      cells_(mean_cells(layer, places, scaled_.extinction_share, options)) {}

SolvedRadiance RadianceSolver::solve(const LayerSources& sources,
                                     const BakeOptions& options) const {
    std::vector<float> depths;
    if (sources.sun > 0) {
        depths =
            light_values(layer_, places_, {{sources.sun_direction}, {{1.0}}, false}, options)[0];
    }
    const CellFields first = first_scattering(places_, scaled_, sources, depths, options);
    const RadianceSweep sweep(cells_, degree_, options);
    EnteringLight entering{sources.sky, sources.ground};
    if (sources.sky_shape) {
        entering.sky_shape = ordinate_radiances(sources.sky_shape, sweep.sky_ordinates());
    }
    AndersonGuesses guesses(options);
    SolvedRadiance result{CellFields(places_.count, first.count()), std::move(depths), 0, 1};
    while (result.change > kLargestChange && result.sweeps < kMostSweeps && !options.cancelled()) {
        CellFields next =
            scattered_again(result.scattered, first, sweep, scaled_, entering, options);
        ++result.sweeps;
        const double size = inner_product(next, next, options);
        CellFields change = next;
        add(result.scattered, -1, change, options);
        const double changed = inner_product(change, change, options);
        result.change = changed > 0 ? std::sqrt(changed / size) : 0;
        result.scattered = result.change > kLargestChange
                               ? guesses.next({std::move(result.scattered), std::move(change)})
                               : std::move(next);
    }
    return result;
}

}  // namespace skybake::cloud_light
