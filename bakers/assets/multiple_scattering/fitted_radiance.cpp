#include "bakers/assets/multiple_scattering/fitted_radiance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "bakers/assets/multiple_scattering/positive_least_squares.h"
#include "bakers/field/image.h"
#include "bakers/math/parallel.h"
#include "bakers/math/relative_error.h"

namespace skybake {

namespace {

Image2<double> mean_radiance(const SolvedLight& light, const FitAxes& axes) {
    Image2<double> image(static_cast<int>(axes.width()), static_cast<int>(axes.height()),
                         light.channels);
    double* texel = image.texels.data();
    for (const double altitude_km : axes.altitudes_km_of_rows) {
        for (const double sun_cos_zenith : axes.sun_cos_zenith_of_columns) {
            const Spectrum psi = light.mean_radiance_at(altitude_km, sun_cos_zenith);
            // The night's last light is interpolated between suns, by a cubic.
            for (int c = 0; c < light.channels; ++c) {
                *texel++ = std::max(psi[static_cast<std::size_t>(c)], 0.0);
            }
        }
    }
    return image;
}

// The scene's equations, one channel at a time.
class ScaledEquations {
  public:
    ScaledEquations(const FitSample& sample, const std::vector<ViewEquations>& views,
                    const Image2<double>& start, double ground_views)
        : sample_(sample), views_(views), start_(start), ground_views_(ground_views) {}

    // For the ratios to the start's texels, in units of the error that ratios of 1 leave; none if
    // they leave none.
    SparseEquations of_channel(std::size_t channel) const {
        const std::vector<double> means = sky_means(channel);
        const double unit = median_error(channel, means);
        SparseEquations equations;
        for (std::size_t v = 0; v < views_.size() && unit > 0; ++v) {
            const ViewEquations& view = views_[v];
            const double share = view_share(sample_.views[v]);
            for (std::size_t i = 0; i < view.multiple.size(); ++i) {
                const double mean = means[dome_of(v, i)];
                if (!(mean > 0)) continue;  // no light at all
                const double scale =
                    std::sqrt(share / static_cast<double>(means.size())) / (mean * unit);
                for (std::size_t t = view.first_term[i]; t < view.first_term[i + 1]; ++t) {
                    equations.add_term(view.texels[t], scale * light_of(view, t, channel));
                }
                equations.end_equation(scale * view.multiple[i][channel]);
            }
        }
        return equations;
    }

  private:
    // Domes: every camera under every sun.
    std::size_t dome_of(std::size_t view, std::size_t ray) const {
        const auto camera = static_cast<std::size_t>(sample_.views[view].camera);
        return camera * sample_.suns.size() + ray / sample_.azimuth_cosines.size();
    }
    // Returns the share of one ray in its dome.
    double view_share(const FitView& view) const {
        return view.share * (view.meets_ground ? ground_views_ : 1) /
               static_cast<double>(sample_.azimuth_cosines.size());
    }
    double light_of(const ViewEquations& view, std::size_t term, std::size_t channel) const {
        const auto channels = static_cast<std::size_t>(start_.channels);
        return view.weights[term][channel] * start_.texels[view.texels[term] * channels + channel];
    }

    // The sum over the rays of each dome's sky of share * value.
    template <class Value>
    std::vector<double> over_skies(const Value& value) const {
        std::vector<double> sums(sample_.cameras_km.size() * sample_.suns.size());
        for (std::size_t v = 0; v < views_.size(); ++v) {
            if (sample_.views[v].meets_ground) continue;
            for (std::size_t i = 0; i < views_[v].multiple.size(); ++i) {
                sums[dome_of(v, i)] += view_share(sample_.views[v]) * value(views_[v], i);
            }
        }
        return sums;
    }

    std::vector<double> sky_means(std::size_t channel) const {
        return over_skies([channel](const ViewEquations& view, std::size_t i) {
            return view.single[i][channel] + view.multiple[i][channel];
        });
    }

    // The median over domes of the RMS error with ratios of 1, as a share of the mean.
    double median_error(std::size_t channel, const std::vector<double>& means) const {
        std::vector<double> squares =
            over_skies([this, channel](const ViewEquations& view, std::size_t i) {
                double error = -view.multiple[i][channel];
                for (std::size_t t = view.first_term[i]; t < view.first_term[i + 1]; ++t) {
                    error += light_of(view, t, channel);
                }
                return error * error;
            });
        for (std::size_t d = 0; d < squares.size(); ++d) {
            squares[d] = means[d] > 0 ? std::sqrt(squares[d]) / means[d] : 0;
        }
        const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
        std::nth_element(squares.begin(), middle, squares.end());
        return *middle;
    }

    const FitSample& sample_;
    const std::vector<ViewEquations>& views_;
    const Image2<double>& start_;
    double ground_views_;
};

std::vector<bool> seen_texels(std::size_t texels, const std::vector<ViewEquations>& views) {
    std::vector<bool> seen(texels);
    for (const ViewEquations& view : views) {
        for (const std::size_t texel : view.texels) seen[texel] = true;
    }
    return seen;
}

// Returns the width of the interval that each of the ascending places represents.
std::vector<double> widths_of(const std::vector<double>& places) {
    if (places.size() == 1) return {1};
    std::vector<double> widths(places.size());
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        const double half = 0.5 * (places[i + 1] - places[i]);
        widths[i] += half;
        widths[i + 1] += half;
    }
    return widths;
}

// Integrals over the unit square of finite elements, so that what is asked of x does not depend on
// the table's size.
Restraint restraint_of(const FitAxes& axes, const SunAxis& sun_axis, double thickness_km,
                       const FitSettings& settings, const std::vector<bool>& seen) {
    std::vector<double> u;
    for (const double cosine : axes.sun_cos_zenith_of_columns) {
        u.push_back(sun_axis.position(cosine) / sun_axis.count());
    }
    std::vector<double> v;
    for (const double altitude_km : axes.altitudes_km_of_rows) {
        v.push_back(altitude_km / thickness_km);
    }
    const std::vector<double> du = widths_of(u);
    const std::vector<double> dv = widths_of(v);
    Restraint restraint;
    const auto link = [&](std::size_t first, std::size_t second, double strength) {
        if (seen[first] && seen[second]) restraint.links.push_back({first, second, strength});
    };
    for (std::size_t y = 0; y < v.size(); ++y) {
        for (std::size_t x = 0; x < u.size(); ++x) {
            const std::size_t texel = y * u.size() + x;
            restraint.towards_one.push_back(settings.towards_one * du[x] * dv[y]);
            if (x + 1 < u.size()) {
                link(texel, texel + 1, settings.sun_smoothness * dv[y] / (u[x + 1] - u[x]));
            }
            if (y + 1 < v.size()) {
                link(texel, texel + u.size(),
                     settings.altitude_smoothness * du[x] / (v[y + 1] - v[y]));
            }
        }
    }
    return restraint;
}

}  // namespace

Image2<double> fit_mean_radiance(const SkyMedium& medium, const SolvedLight& light,
                                 const FitScene& scene, const FitAxes& axes,
                                 const FitSettings& settings, int threads) {
    Image2<double> image = mean_radiance(light, axes);
    const FitSample sample =
        sample_scene(shell_of(medium.air), light.suns, scene, settings.density);
    std::vector<ViewEquations> views(sample.views.size());
    parallel_for(static_cast<int>(views.size()), threads, [&](int i) {
        const auto v = static_cast<std::size_t>(i);
        views[v] = view_equations(medium, light, sample, sample.views[v], axes);
    });
    const ScaledEquations equations(sample, views, image, settings.ground_views);
    const Restraint restraint = restraint_of(axes, light.suns, medium.air.thickness_km, settings,
                                             seen_texels(axes.texels(), views));
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<std::vector<double>> ratios(channels);
    parallel_for(image.channels, threads, [&](int i) {
        const auto channel = static_cast<std::size_t>(i);
        ratios[channel] =
            positive_least_squares(equations.of_channel(channel), restraint, settings.tolerance);
    });
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        image.texels[i] *= ratios[i % channels][i / channels];
    }
    return image;
}

Image2<double> fitted_texels(const SkyMedium& medium, const SolvedLight& light,
                             const std::optional<config::Scene>& scene, const SunColumns& columns,
                             std::array<int, 2> size, int threads) {
    FitScene fit;
    if (scene) {
        fit.lowest_camera_km = scene->altitude[0].kilometers();
        fit.highest_camera_km = scene->altitude[1].kilometers();
        fit.smallest_sun_zenith = 0.5 * std::numbers::pi - scene->sun_elevation[1].radians;
        fit.largest_sun_zenith = 0.5 * std::numbers::pi - scene->sun_elevation[0].radians;
    }
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    FitAxes axes;
    for (int x = 0; x < size[0]; ++x) {
        axes.sun_cos_zenith_of_columns.push_back(
            columns.cosine(texel_coordinate(kConvention, x, size[0])));
    }
    for (int y = 0; y < size[1]; ++y) {
        axes.altitudes_km_of_rows.push_back(medium.air.thickness_km *
                                            texel_coordinate(kConvention, y, size[1]));
    }
    axes.column_of = [&columns, size](double sun_cos_zenith) {
        return columns.coordinate(sun_cos_zenith) * (size[0] - 1);
    };
    return fit_mean_radiance(medium, light, fit, axes, {}, threads);
}

TableModel fitted_model(const Image2<double>& texels) {
    TableModel model;
    model.channels = texels.channels;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    model.cost_per_texel = {1};
    model.row = [&texels](int, double y, const std::vector<double>& x, double* values) {
        const double row = y * (texels.height - 1);
        const int low = std::min(static_cast<int>(row), std::max(texels.height - 2, 0));
        const int high = std::min(low + 1, texels.height - 1);
        for (const double coordinate : x) {
            const double column = coordinate * (texels.width - 1);
            const int left = std::min(static_cast<int>(column), std::max(texels.width - 2, 0));
            const int right = std::min(left + 1, texels.width - 1);
            for (int c = 0; c < texels.channels; ++c) {
                const auto between = [c, s = column - left](const double* a, const double* b) {
                    return a[c] + s * (b[c] - a[c]);
                };
                const double below = between(texels.texel(left, low), texels.texel(right, low));
                const double above = between(texels.texel(left, high), texels.texel(right, high));
                *values++ = below + (row - low) * (above - below);
            }
        }
    };
    model.reference = [row = model.row](double y, const std::vector<double>& x, double* values) {
        row(0, y, x, values);
    };
    model.error = relative_error;
    return model;
}

}  // namespace skybake
