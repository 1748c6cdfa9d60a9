#include "bakers/render/sun_disc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "bakers/air/ray.h"

namespace skybake {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kDiscRadius = 0.2665 * kRadiansPerDegree;
constexpr double kDiscSolidAngle = std::numbers::pi * kDiscRadius * kDiscRadius;
constexpr double kGreenNm = 550;
// The mean over a pixel is that of points which lie so densely.
constexpr double kPointsPerRadius = 10;
// From this many radii on, the veil of the disc is that of a point to 1 %, and even over a pixel.
constexpr double kPointFromRadii = 10;
constexpr int kRings = 32;
constexpr int kSpokes = 48;
constexpr double kWidestGlare = std::numbers::pi / 2;
constexpr double kScatteredByLens = 0.01;

double angle_to_sun(const SkyDirection& direction) {
    return 2 * std::asin(std::min(1.0, std::sqrt(0.5 * direction.one_minus_cosine)));
}

// The sun as a camera sees it through the air.
struct SeenSun {
    const SkyMedium& medium;
    const SkyTables& tables;
    const SkyView& view;
    Shell shell;
    double r_km;
    double horizon;  // the cosine of the zenith angle there

    // The light of one point of the sun, in 1/sr times its share of the disc's mean brightness.
    Spectrum sunlight(double mu) const {
        if (mu < horizon) return Spectrum{};
        return look_up_sunlight(tables, shell, view.camera_altitude_km, r_km * mu);
    }

    Spectrum radiance(const SkyDirection& direction) const {
        const double share = angle_to_sun(direction) / kDiscRadius;
        if (share >= 1) return Spectrum{};
        Spectrum light = sunlight(direction.mu);
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            light[c] *= limb_darkening(share, wavelength_nm_of(tables, c)) / kDiscSolidAngle;
        }
        return light;
    }
};

SeenSun seen_sun(const SkyMedium& medium, const SkyTables& tables, const SkyView& view) {
    const Shell shell = shell_of(medium.air);
    const double r = shell.ground_radius_km + view.camera_altitude_km;
    return {medium, tables, view,
            shell,  r,      -horizon_distance_km(shell, view.camera_altitude_km) / r};
}

// Calls `visit(across, up, weight)` for points spread evenly over a disc of radius 1. Weights add up
// to 1.
template <class Visit>
void for_each_disc_point(const Visit& visit) {
    for (int ring = 0; ring < kRings; ++ring) {
        const double radius = std::sqrt((ring + 0.5) / kRings);
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const double turn = 2 * std::numbers::pi * (spoke + 0.5) / kSpokes;
            visit(radius * std::cos(turn), radius * std::sin(turn), 1.0 / (kRings * kSpokes));
        }
    }
}

// Returns the sunlight that the whole disc sends to the camera, as a share of that outside the air.
Spectrum light_of_disc(const SeenSun& sun) {
    Spectrum light{};
    for_each_disc_point([&](double across, double up, double weight) {
        const double elevation =
            sun.view.sun_elevation_degrees * kRadiansPerDegree + up * kDiscRadius;
        const Spectrum point = sun.sunlight(std::sin(elevation));
        const double share = std::sqrt(across * across + up * up);
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            light[c] += weight * point[c] * limb_darkening(share, wavelength_nm_of(sun.tables, c));
        }
    });
    return light;
}

// Returns the share of the light that an eye's veil takes: its integral over the half sphere that the
// eye sees.
double share_of_veil() {
    constexpr int kSteps = 2000;
    double share = 0;
    // In u^3, since most of the veil is next to the sun.
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double angle = kWidestGlare * u * u * u;
        const double width = kWidestGlare * 3 * u * u / kSteps;
        share +=
            std::numbers::pi * std::sin(2 * angle) * width * glare_veil(angle / kRadiansPerDegree);
    }
    return share;
}

// An eye's veil of a disc of even brightness around its middle, in 1/sr. Pictures share one, which
// takes 400 000 values of glare_veil to make.
class EyesVeil {
  public:
    static const EyesVeil& shared() {
        static const EyesVeil veil;
        return veil;
    }

    double share_of_light() const { return share_of_light_; }

    double at(double angle) const {
        const double steps = angle / kStep;
        const auto step = static_cast<std::size_t>(steps);
        if (step + 1 >= near_.size()) {
            return glare_veil(angle / kRadiansPerDegree);
        }
        return std::lerp(near_[step], near_[step + 1], steps - static_cast<double>(step));
    }

  private:
    EyesVeil() {
        for (std::size_t i = 0; i < near_.size(); ++i) {
            const double angle = kStep * static_cast<double>(i);
            for_each_disc_point([&](double across, double up, double weight) {
                const double distance = std::hypot(angle - across * kDiscRadius, up * kDiscRadius);
                near_[i] += weight * glare_veil(distance / kRadiansPerDegree);
            });
        }
    }

    static constexpr int kStepsPerRadius = 25;
    static constexpr double kStep = kDiscRadius / kStepsPerRadius;
    double share_of_light_ = share_of_veil();
    std::array<double, static_cast<std::size_t>(kPointFromRadii* kStepsPerRadius) + 1> near_{};
};

// The sun and its glare, as pictures add them.
struct Sun {
    const SeenSun& seen;
    Glare glare;
    Spectrum whole;  // the light that is scattered

    // The angle from the sun beyond which it adds nothing.
    double reach() const { return glare == Glare::none ? kDiscRadius : kWidestGlare; }

    double scattered() const {
        if (glare == Glare::none) return 0;
        return glare == Glare::eye ? EyesVeil::shared().share_of_light() : kScatteredByLens;
    }

    // The veil is per illuminance of the picture's plane, or the pupil's, which faces the pixel.
    double veil(double angle) const {
        if (glare == Glare::none || angle >= kWidestGlare) return 0;
        const double toward_source = glare == Glare::eye ? EyesVeil::shared().at(angle)
                                                         : lens_veil(angle / kRadiansPerDegree);
        return std::cos(angle) * toward_source;
    }

    Spectrum radiance(const SkyDirection& direction) const {
        return (1 - scattered()) * seen.radiance(direction) + whole * veil(angle_to_sun(direction));
    }
};

// Returns the mean over a pixel near the sun.
Spectrum mean_over_pixel(const Sun& sun, int x, int y, int points) {
    Spectrum mean{};
    int count = 0;
    for (int j = 0; j < points; ++j) {
        for (int i = 0; i < points; ++i) {
            const auto direction =
                direction_through(sun.seen.view, x + (i + 0.5) / points, y + (j + 0.5) / points);
            if (!direction) continue;
            mean += sun.radiance(*direction);
            ++count;
        }
    }
    return count > 0 ? mean / double(count) : mean;
}

// Returns an angle that is longer than any pixel's diagonal.
double widest_pixel(const SkyView& view) {
    if (view.projection == SkyProjection::dome) {
        return 2 * std::numbers::pi / std::min(view.width, view.height);
    }
    const double high =
        (view.highest_degrees - view.lowest_degrees) / view.height * kRadiansPerDegree;
    return high + view.azimuth_span_degrees / view.width * kRadiansPerDegree;
}

}  // namespace

double limb_exponent(double wavelength_nm) { return -0.023 + 292 / wavelength_nm; }

double wavelength_nm_of(const SkyTables& tables, std::size_t channel) {
    const auto& known = tables.wavelengths_nm;
    return channel < known.size() ? known[channel] : kGreenNm;
}

double limb_darkening(double angle_share, double wavelength_nm) {
    const double alpha = limb_exponent(wavelength_nm);
    const double mu_squared = (1 - angle_share) * (1 + angle_share);
    return (1 + alpha / 2) * std::pow(mu_squared, alpha / 2);
}

double glare_veil(double degrees) {
    constexpr double kAge = 25;
    constexpr double kPigmentation = 0.5;
    constexpr double kAgeToTheFourth = kAge * kAge * kAge * kAge / (70. * 70 * 70 * 70);
    constexpr double kOfAge = 1 + 1.6 * kAgeToTheFourth;
    const double t = 1 + degrees * degrees / 0.01;
    const double root = std::sqrt(t);
    const double narrow = 1 + degrees * degrees / (0.045 * 0.045);
    return (1 - 0.08 * kAgeToTheFourth) * 1.5e5 / (narrow * std::sqrt(narrow)) +
           kOfAge * (400 / t + 3e-8 * degrees * degrees +
                     kPigmentation * (1300 / (t * root) + 0.8 / root)) +
           2.5e-3 * kPigmentation;
}

double lens_veil(double degrees) {
    constexpr double kCore = kDiscRadius * kDiscRadius;
    static const double scale = kScatteredByLens / (std::numbers::pi * std::log(1 + 1 / kCore));
    const double sine = std::sin(degrees * kRadiansPerDegree);
    return scale / (sine * sine + kCore);
}

void add_sun(const SkyMedium& medium, const SkyTables& tables, const SkyView& view, Glare glare,
             Image2<float>& radiance) {
    const SeenSun seen = seen_sun(medium, tables, view);
    const bool has_veil = glare != Glare::none;
    const Sun sun{seen, glare, has_veil ? light_of_disc(seen) : Spectrum{}};
    const double radii = has_veil ? kPointFromRadii : 1;
    const double near = radii * kDiscRadius + widest_pixel(view);
    const auto points =
        static_cast<int>(std::ceil(kPointsPerRadius * widest_pixel(view) / kDiscRadius));
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const std::optional<SkyDirection> direction = direction_at(view, x, y);
            if (!direction) continue;
            const double angle = angle_to_sun(*direction);
            if (angle > std::max(near, sun.reach())) continue;
            const Spectrum light =
                angle > near ? sun.radiance(*direction) : mean_over_pixel(sun, x, y, points);
            for (int c = 0; c < radiance.channels; ++c) {
                radiance.texel(x, y)[c] += static_cast<float>(light[static_cast<std::size_t>(c)]);
            }
        }
    }
}

}  // namespace skybake
