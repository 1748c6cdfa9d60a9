#include "bakers/light/sky_spectra.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bakers/air/forward_peak.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/sky_row.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/sections/layer.h"
#include "config/sections/spectral_air.h"

namespace skybake {
namespace {

// Spectra are known at these wavelengths.
constexpr double kFirst_nm = 380;
constexpr double kLast_nm = 780;
constexpr double kStep_nm = 5;
// Spheres cost much to average, and scatter almost alike at neighbouring wavelengths: series are
// summed at every so many nm, and interpolated.
constexpr config::Length kStepOfSpheres{50e-9};

// Enough for the shape of a spectrum: the mean radiance of Earth is 1 % off. Twice to four times as
// many azimuths move the colours of presets by 1e-4 at most.
constexpr SolverSettings kFewNodes = {.degree = 2,
                                      .suns = 16,
                                      .level_scale = 0.5,
                                      .zenith_nodes = 4,
                                      .first_zenith_nodes = 4,
                                      .first_azimuths = 8,
                                      .ray_tolerance = 0.1,
                                      .sunlight = {64, 32},
                                      .orders = 3};

// The size of the table from which rows read sunlight: a finer one moves colours by 2e-5.
constexpr TransmittanceField::Size kSunlightOfRows = {.columns = 64, .rows = 16, .least_rows = 5};

// The camera, the suns and the views. The views under each second sun are measured, not fitted.
constexpr double kCameraShare = 0.02;  // of the air's thickness
constexpr std::array kSuns_deg = {80.0, 60.0, 40.0, 25.0, 15.0, 9.0,  6.0,  4.0, 2.5,
                                  1.0,  0.0,  -1.0, -2.0, -3.0, -4.0, -5.0, -6.0};
constexpr std::array kViews_deg = {1.0, 4.0, 12.0, 30.0, 60.0, 88.0, -20.0};
constexpr std::array kAzimuths_deg = {3.0, 40.0, 110.0, 175.0};

SunZenith sun_at_deg(double elevation_deg) {
    const double quarter = elevation_deg / 180;
    return {cosine_of_pi(0.5 - quarter), cosine_of_pi(quarter)};
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
        : whole_(make_sky_medium(atmosphere)),
          medium_(without_forward_peaks(whole_)),
          shell_(shell_of(medium_.air)),
          light_(solve_light(medium_, kFewNodes, 1)),
          orders_(medium_, light_, kFewNodes.degree),
          integrator_(medium_, &orders_),
          sun_(whole_, nullptr) {}

    // Views at the same height above the horizon share their way through the air.
    std::vector<Spectrum> by_rows(const std::vector<SpectrumView>& views) const {
        const TransmittanceField sunlight(medium_.air, quadrature_altitudes_km(medium_.air),
                                          kSunlightOfRows, 1);
        std::map<double, std::vector<std::size_t>> heights_deg;
        for (std::size_t i = 0; i < views.size(); ++i) {
            heights_deg[views[i].above_deg].push_back(i);
        }
        std::vector<Spectrum> light(views.size());
        for (const auto& [height_deg, row] : heights_deg) {
            const SkyRow way(integrator_, medium_, &orders_, ray_of(views[row.front()], 1),
                             &sunlight);
            std::vector<SkyRay> rays;
            for (const std::size_t i : row) {
                rays.push_back(ray_of(views[i], azimuth_cosine(views[i])));
            }
            const std::vector<SkyRadiance> of_row = way.radiance(rays);
            for (std::size_t k = 0; k < row.size(); ++k) light[row[k]] = of_row[k].total();
        }
        return light;
    }

    Spectrum by_ray(const SpectrumView& view) const {
        return integrator_.radiance(ray_of(view, azimuth_cosine(view))).total();
    }

    // The sunlight that reaches the ground.
    Spectrum of_sun(double elevation_deg) const {
        return sun_.sunlight(0, shell_.ground_radius_km * sun_at_deg(elevation_deg).cosine);
    }

  private:
    static double azimuth_cosine(const SpectrumView& view) {
        return cosine_of_pi(view.azimuth_deg / 180);
    }

    // The ray of a view towards another azimuth.
    SkyRay ray_of(const SpectrumView& view, double azimuth_cosine) const {
        const double altitude_km = kCameraShare * shell_.thickness_km;
        const double above = view.above_deg / 180;
        // The horizon lies below the horizontal.
        const double r = shell_.ground_radius_km + altitude_km;
        const double dip_cosine = shell_.ground_radius_km / r;
        const double dip_sine = horizon_distance_km(shell_, altitude_km) / r;
        const double sine = cosine_of_pi(0.5 - above);
        const double cosine = cosine_of_pi(above);
        const double mu = sine * dip_cosine - cosine * dip_sine;
        return sky_ray(shell_, altitude_km, view.sun,
                       sky_direction(view.sun, mu, std::sqrt(std::max((1 - mu) * (1 + mu), 0.0)),
                                     azimuth_cosine));
    }

    SkyMedium whole_;
    // Few nodes cannot solve for the light of peaks, which counts as not scattered.
    SkyMedium medium_;
    Shell shell_;
    SolvedLight light_;
    SolvedOrders orders_;
    SkyIntegrator integrator_, sun_;
};

config::Atmosphere air_of_spectra(const config::Atmosphere& atmosphere,
                                  const std::vector<config::Length>& given,
                                  const std::vector<config::Length>& wanted) {
    config::Atmosphere air = config::atmosphere_at(atmosphere, given, wanted);
    for (config::Layer& layer : air.layers) layer.particles.step = kStepOfSpheres;
    return air;
}

}  // namespace

std::vector<SpectrumView> spectrum_views() {
    std::vector<SpectrumView> all;
    for (const double sun : kSuns_deg) {
        for (const double above : kViews_deg) {
            for (const double azimuth : kAzimuths_deg) {
                all.push_back({sun_at_deg(sun), above, azimuth});
            }
        }
    }
    return all;
}

bool is_fitted(std::size_t view) {
    return view / (kViews_deg.size() * kAzimuths_deg.size()) % 2 == 0;
}

std::vector<double> spectrum_nm() {
    std::vector<double> wavelengths;
    for (double nm = kFirst_nm; nm <= kLast_nm; nm += kStep_nm) wavelengths.push_back(nm);
    return wavelengths;
}

Spectra sky_spectra(const config::Atmosphere& atmosphere,
                    const std::vector<config::Length>& wavelengths,
                    const std::vector<SpectrumView>& views, const BakeOptions& options,
                    SpectrumRays rays) {
    const std::vector<double> nm = spectrum_nm();
    const std::vector<std::size_t> order = packet_order(nm.size());
    const std::size_t size = kMaxChannels;
    Spectra spectra(views.size() + kSpectrumDiscs_deg.size(), std::vector<double>(nm.size()));
    const auto packets = static_cast<int>((order.size() + size - 1) / size);
    for_each_tile(packets, options, "fitting colours", [&](int p) {
        const std::size_t first = static_cast<std::size_t>(p) * size;
        std::vector<config::Length> of_packet;
        for (std::size_t i = first; i < std::min(first + size, order.size()); ++i) {
            of_packet.push_back({nm[order[i]] / 1e9});
        }
        const PacketLight light(air_of_spectra(atmosphere, wavelengths, of_packet));
        const auto put = [&](std::size_t sample, const Spectrum& value) {
            for (std::size_t c = 0; c < of_packet.size(); ++c) {
                spectra[sample][order[first + c]] = value[c];
            }
        };
        const bool by_rows = rays == SpectrumRays::in_rows;
        const std::vector<Spectrum> of_rows =
            by_rows ? light.by_rows(views) : std::vector<Spectrum>();
        for (std::size_t i = 0; i < views.size(); ++i) {
            put(i, by_rows ? of_rows[i] : light.by_ray(views[i]));
        }
        for (std::size_t i = 0; i < kSpectrumDiscs_deg.size(); ++i) {
            put(views.size() + i, light.of_sun(kSpectrumDiscs_deg[i]));
        }
    });
    return spectra;
}

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

}  // namespace skybake
