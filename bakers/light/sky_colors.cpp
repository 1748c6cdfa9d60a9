#include "bakers/light/sky_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>
#include <utility>

#include "bakers/air/optical_depth.h"
#include "bakers/color/color_weights_fit.h"
#include "bakers/color/spectral_color.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/sections/spectral_air.h"

namespace skybake {

namespace {

// Spectra are known at these wavelengths.
constexpr double kFirst_nm = 380;
constexpr double kLast_nm = 780;
constexpr double kStep_nm = 5;
// Spheres scatter almost alike at neighbouring wavelengths, and cost much to average: they are
// taken at every so many nm.
constexpr double kStepOfSpheres_nm = 50;

// Enough for the shape of a spectrum: the mean radiance of Earth is 1 % off.
constexpr SolverSettings kFewNodes = {.degree = 2,
                                      .suns = 16,
                                      .level_scale = 0.5,
                                      .zenith_nodes = 4,
                                      .first_zenith_nodes = 4,
                                      .ray_tolerance = 0.1,
                                      .sunlight = {64, 32},
                                      .orders = 3};

// The camera, the suns and the views. The views under each second sun are measured, not fitted.
constexpr double kCameraShare = 0.02;  // of the air's thickness
constexpr std::array kSuns_deg = {80.0, 60.0, 40.0, 25.0, 15.0, 9.0,  6.0,  4.0,
                                  2.5,  1.0,  0.0,  -1.0, -2.0, -3.0, -4.0, -5.0};
constexpr std::array kViews_deg = {1.0, 4.0, 12.0, 30.0, 60.0, 88.0, -20.0};
constexpr std::array kAzimuths_deg = {3.0, 40.0, 110.0, 175.0};
constexpr std::array kDiscs_deg = {90.0, 40.0, 20.0, 10.0, 5.0, 3.0, 2.0, 1.0, 0.5, 0.0};
constexpr std::array kMeasuredDiscs_deg = {5.0, 1.0, 0.0};
// The sun's own light counts as so many views, since it lights all that a runtime draws.
constexpr double kWeightOfDisc = 4;

bool is_fitted(std::size_t view) {
    return view / (kViews_deg.size() * kAzimuths_deg.size()) % 2 == 0;
}

struct View {
    SunZenith sun;
    double above_deg = 0;
    double azimuth_deg = 0;
};

SunZenith sun_at_deg(double elevation_deg) {
    const double quarter = elevation_deg / 180;
    return {cosine_of_pi(0.5 - quarter), cosine_of_pi(quarter)};
}

std::vector<View> views() {
    std::vector<View> all;
    for (const double sun : kSuns_deg) {
        for (const double above : kViews_deg) {
            for (const double azimuth : kAzimuths_deg) {
                all.push_back({sun_at_deg(sun), above, azimuth});
            }
        }
    }
    return all;
}

std::vector<double> spectrum_nm() {
    std::vector<double> wavelengths;
    for (double nm = kFirst_nm; nm <= kLast_nm; nm += kStep_nm) wavelengths.push_back(nm);
    return wavelengths;
}

// Returns the order in which wavelengths fall into packets: each packet has some from all of the
// spectrum, so that all have grids alike, whose errors are then smooth over wavelengths.
std::vector<std::size_t> packet_order(std::size_t count) {
    const std::size_t packets = (count + kMaxChannels - 1) / kMaxChannels;
    std::vector<std::size_t> order;
    for (std::size_t packet = 0; packet < packets; ++packet) {
        for (std::size_t i = packet; i < count; i += packets) order.push_back(i);
    }
    return order;
}

// The light of one packet of wavelengths: of each view, then of each of the sun's elevations.
class PacketLight {
  public:
    explicit PacketLight(const config::Atmosphere& atmosphere)
        : medium_(make_sky_medium(atmosphere)),
          shell_(shell_of(medium_.air)),
          light_(solve_light(medium_, kFewNodes, 1)),
          orders_(medium_, light_, kFewNodes.degree),
          integrator_(medium_, &orders_) {}

    Spectrum of(const View& view) const {
        const double altitude_km = kCameraShare * shell_.thickness_km;
        const double above = view.above_deg / 180;
        // The horizon lies below the horizontal.
        const double r = shell_.ground_radius_km + altitude_km;
        const double dip_cosine = shell_.ground_radius_km / r;
        const double dip_sine = horizon_distance_km(shell_, altitude_km) / r;
        const double sine = cosine_of_pi(0.5 - above);
        const double cosine = cosine_of_pi(above);
        const double mu = sine * dip_cosine - cosine * dip_sine;
        const SkyDirection direction =
            sky_direction(view.sun, mu, std::sqrt(std::max((1 - mu) * (1 + mu), 0.0)),
                          cosine_of_pi(view.azimuth_deg / 180));
        return integrator_.radiance(altitude_km, view.sun, direction).total();
    }

    // The sunlight that reaches the ground.
    Spectrum of_sun(double elevation_deg) const {
        return integrator_.sunlight(0, shell_.ground_radius_km * sun_at_deg(elevation_deg).cosine);
    }

  private:
    SkyMedium medium_;
    Shell shell_;
    SolvedLight light_;
    SolvedOrders orders_;
    SkyIntegrator integrator_;
};

// Spheres at the nearest of a few wavelengths.
void take_few_spheres(config::Atmosphere& atmosphere) {
    for (config::Layer& layer : atmosphere.layers) {
        for (config::Length& wavelength : layer.particles.wavelengths) {
            const double steps = std::round(wavelength.meters * 1e9 / kStepOfSpheres_nm);
            wavelength = {steps * kStepOfSpheres_nm / 1e9};
        }
    }
}

// Replaces a tabulated profile, each entry of which is a kink that costs time, by a smooth one with
// the same column, mean altitude and, of gases above the ground, spread. Spectra depend on columns.
void take_smooth_profile(config::Layer& layer) {
    double column = 0;
    double first = 0;  // moments over altitude, in m
    double second = 0;
    for (std::size_t i = 0; i + 1 < layer.table.size(); ++i) {
        const double low = layer.table[i].altitude.meters;
        const double high = layer.table[i + 1].altitude.meters;
        const double middle = (low + high) / 2;
        const double part =
            (high - low) * (layer.table[i].density + layer.table[i + 1].density) / 2;
        column += part;
        first += part * middle;
        second += part * middle * middle;
    }
    const double mean = first / column;
    const bool is_at_ground = layer.table.front().density >= layer.table.back().density &&
                              layer.table.front().density > 0.5;
    layer.table.clear();
    if (is_at_ground) {
        layer.profile = config::Profile::exponential;
        layer.scale_height = {mean};
        return;
    }
    // The variance of a tent is a sixth of its half width squared.
    layer.profile = config::Profile::tent;
    layer.center_altitude = {mean};
    layer.half_width = {std::sqrt(6 * std::max(second / column - mean * mean, 1.0))};
}

config::Atmosphere air_of_spectra(const ColorRequest& request,
                                  const std::vector<config::Length>& wavelengths) {
    config::Atmosphere smooth = request.atmosphere;
    for (config::Layer& layer : smooth.layers) {
        if (layer.gas && layer.profile == config::Profile::tabulated) take_smooth_profile(layer);
    }
    config::Atmosphere air = config::atmosphere_at(smooth, request.wavelengths, wavelengths);
    take_few_spheres(air);
    return air;
}

// The spectra of all views and of the sun: radiance[sample][wavelength].
using Spectra = std::vector<std::vector<double>>;

Spectra spectra_of(const ColorRequest& request, const std::vector<View>& wanted,
                   const BakeOptions& options) {
    const std::vector<double> nm = spectrum_nm();
    const std::vector<std::size_t> order = packet_order(nm.size());
    const std::size_t size = kMaxChannels;
    Spectra spectra(wanted.size() + kDiscs_deg.size(), std::vector<double>(nm.size()));
    const auto packets = static_cast<int>((order.size() + size - 1) / size);
    for_each_tile(packets, options, "fitting colours", [&](int p) {
        const std::size_t first = static_cast<std::size_t>(p) * size;
        std::vector<config::Length> wavelengths;
        for (std::size_t i = first; i < std::min(first + size, order.size()); ++i) {
            wavelengths.push_back({nm[order[i]] / 1e9});
        }
        const PacketLight light(air_of_spectra(request, wavelengths));
        const auto put = [&](std::size_t sample, const Spectrum& value) {
            for (std::size_t c = 0; c < wavelengths.size(); ++c) {
                spectra[sample][order[first + c]] = value[c];
            }
        };
        for (std::size_t i = 0; i < wanted.size(); ++i) put(i, light.of(wanted[i]));
        for (std::size_t i = 0; i < kDiscs_deg.size(); ++i) {
            put(wanted.size() + i, light.of_sun(kDiscs_deg[i]));
        }
    });
    return spectra;
}

// Returns the spectra at the recipe's wavelengths, by lines; beyond their ends they are constant.
Spectra at_wavelengths(const Spectra& spectra, const std::vector<config::Length>& wavelengths) {
    Spectra few;
    for (const std::vector<double>& spectrum : spectra) {
        std::vector<double> light;
        for (const config::Length wavelength : wavelengths) {
            const double steps = (wavelength.meters * 1e9 - kFirst_nm) / kStep_nm;
            const double most = static_cast<double>(spectrum.size() - 1);
            const double place = std::clamp(steps, 0.0, most);
            const auto low = std::min(static_cast<std::size_t>(place), spectrum.size() - 2);
            const double share = place - static_cast<double>(low);
            light.push_back(spectrum[low] + share * (spectrum[low + 1] - spectrum[low]));
        }
        few.push_back(std::move(light));
    }
    return few;
}

ColorTarget target_of(const config::Color& color) {
    ColorTarget target;
    switch (color.space) {
        case config::ColorSpace::linear_srgb:
        case config::ColorSpace::none:
            target.space = ColorSpace::linear_srgb;
            break;
        case config::ColorSpace::rec2020:
            target.space = ColorSpace::rec2020;
            break;
        case config::ColorSpace::acescg:
            target.space = ColorSpace::acescg;
            break;
        case config::ColorSpace::xyz:
            target.space = ColorSpace::xyz;
            break;
    }
    target.white = color.white == config::WhitePoint::sun ? White::sun : White::own;
    target.sunlight =
        color.sun == config::SunSpectrum::measured ? Sunlight::measured : Sunlight::flat;
    return target;
}

std::vector<double> in_nm(const std::vector<config::Length>& wavelengths) {
    std::vector<double> nm;
    for (const config::Length wavelength : wavelengths) nm.push_back(wavelength.meters * 1e9);
    return nm;
}

// Spectra as the fit and its measurement need them.
class ColorSamples {
  public:
    ColorSamples(Spectra spectra, const Spectra& few, const std::vector<double>& nm,
                 const ColorTarget& target)
        : few_(few), weights_(color_weights(nm, target)) {
        ColorTarget luminance = target;
        luminance.space = ColorSpace::xyz;
        luminance.white = White::own;
        const std::vector<glm::dvec3> xyz = color_weights(nm, luminance);
        for (const std::vector<double>& spectrum : spectra) {
            glm::dvec3 color(0);
            double y = 0;
            for (std::size_t i = 0; i < spectrum.size(); ++i) {
                color += spectrum[i] * weights_[i];
                y += spectrum[i] * xyz[i].y;
            }
            colors_.push_back(color);
            luminances_.push_back(y);
        }
    }

    // Returns the sample as the fit takes it. Without light it has weight 0.
    ColorSample sample(std::size_t i, double weight) const {
        const double y = luminances_[i];
        return {few_[i], colors_[i], y > 0 ? weight / y : 0};
    }

    // The largest difference of a channel over luminance, or 0 without light.
    double error(std::size_t i, const std::vector<glm::dvec3>& weights) const {
        glm::dvec3 color(0);
        for (std::size_t k = 0; k < weights.size(); ++k) color += few_[i][k] * weights[k];
        const glm::dvec3 apart = glm::abs(color - colors_[i]);
        const double y = luminances_[i];
        return y > 0 ? std::max(std::max(apart.x, apart.y), apart.z) / y : 0;
    }

  private:
    const Spectra& few_;
    std::vector<glm::dvec3> weights_;
    std::vector<glm::dvec3> colors_;
    std::vector<double> luminances_;
};

ColorError error_of(const ColorSamples& samples, std::size_t views,
                    const std::vector<glm::dvec3>& weights) {
    ColorError error;
    std::vector<double> errors;
    for (std::size_t i = 0; i < views; ++i) {
        if (!is_fitted(i)) errors.push_back(samples.error(i, weights));
    }
    std::sort(errors.begin(), errors.end());
    error.skies = static_cast<int>(errors.size());
    error.median = errors[errors.size() / 2];
    error.ninth_decile = errors[errors.size() * 9 / 10];
    error.max = errors.back();
    for (std::size_t d = 0; d < kMeasuredDiscs_deg.size(); ++d) {
        const auto at = std::find(kDiscs_deg.begin(), kDiscs_deg.end(), kMeasuredDiscs_deg[d]);
        error.disc[d] =
            samples.error(views + static_cast<std::size_t>(at - kDiscs_deg.begin()), weights);
    }
    return error;
}

SkyColors fit(const ColorRequest& request, const BakeOptions& options) {
    const std::vector<View> wanted = views();
    const Spectra spectra = spectra_of(request, wanted, options);
    if (options.cancelled()) return {};
    const std::vector<double> all_nm = spectrum_nm();
    const Spectra few = at_wavelengths(spectra, request.wavelengths);
    const ColorTarget target = target_of(request.color);
    const ColorSamples samples(spectra, few, all_nm, target);
    std::vector<ColorSample> fitted;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        const bool is_disc = i >= wanted.size();
        if (is_disc || is_fitted(i))
            fitted.push_back(samples.sample(i, is_disc ? kWeightOfDisc : 1));
    }
    // The sun outside the air.
    glm::dvec3 white(0);
    for (const glm::dvec3& weight : color_weights(all_nm, target)) white += weight;
    fitted.push_back({std::vector<double>(request.wavelengths.size(), 1.0), white, kWeightOfDisc});
    SkyColors colors;
    colors.weights = fit_color_weights(in_nm(request.wavelengths), fitted, target);
    colors.error = error_of(samples, wanted.size(), colors.weights);
    return colors;
}

constexpr double kSecondsOfFit = 1;

}  // namespace

Need need_of(const ColorRequest& request) {
    return {NeedKey(request), "colours of wavelengths", kSecondsOfFit, 0};
}

std::shared_ptr<const SkyColors> colors_of(const ColorRequest& request,
                                           const BakeOptions& options) {
    return shared_or_made<SkyColors>(
        options.intermediates, NeedKey(request), [&]() -> std::shared_ptr<const SkyColors> {
            auto colors = std::make_shared<const SkyColors>(fit(request, options));
            return options.cancelled() ? nullptr : colors;
        });
}

std::vector<config::Atmosphere> packets_of(const config::Atmosphere& atmosphere) {
    std::vector<config::Atmosphere> packets;
    const std::size_t count = atmosphere.ground_albedo.size();
    for (std::size_t first = 0; first < count; first += kMaxChannels) {
        packets.push_back(config::channels_of(atmosphere, first,
                                              std::min<std::size_t>(count - first, kMaxChannels)));
    }
    return packets;
}

}  // namespace skybake
