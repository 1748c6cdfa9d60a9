#include "bakers/assets/bruneton/scattering_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/field/certify.h"
#include "bakers/field/image.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/relative_error.h"

namespace skybake {

namespace {

constexpr int kQuickPoints = 64;
constexpr int kFullPoints = 4096;
// The golden section, for the fourth coordinate: it is in no rational relation to the plastic
// number of the other three.
constexpr double kGoldenSection = 0.6180339887498949;

// A direction that there is, and where the table has it.
struct Direction {
    ScatteringView view;
    double sun_cos_zenith = 0;
    double nu = 0;
};

double view_cosine(const Shell& shell, const ScatteringView& view) {
    return std::clamp(view.s_km / (shell.ground_radius_km + view.altitude_km), -1.0, 1.0);
}

class ScatteringErrors {
  public:
    ScatteringErrors(const DenseVolume& table, const ScatteringMapping& mapping,
                     const ExactTexel& exact, const std::vector<double>& largest,
                     config::PixelType type)
        : table_(table), mapping_(mapping), exact_(exact), largest_(largest), type_(type) {}

    Direction direction(int index) const {
        const std::array<double, 3> point = low_discrepancy_point(index);
        const bool meets_ground = point[1] < 0.5;
        Direction result;
        result.view = mapping_.view(std::fabs(2 * point[1] - 1), meets_ground, point[2]);
        result.sun_cos_zenith = mapping_.sun_cos_zenith(point[0]);
        const FeasibleCosines feasible =
            feasible_cosines(view_cosine(mapping_.shell(), result.view), result.sun_cos_zenith);
        const double share = (index + 0.5) * kGoldenSection;
        result.nu = std::clamp(
            feasible.low + (share - std::floor(share)) * (feasible.high - feasible.low), -1.0, 1.0);
        return result;
    }

    // Of each channel.
    std::vector<double> lookup(const Direction& at) const {
        return errors(look_up(table_, mapping_,
                              mapping_.coordinates(at.view, at.sun_cos_zenith, at.nu), type_),
                      at);
    }

    // Of the texel next to it; none where its nu is not feasible.
    std::vector<double> texel(const Direction& near) const {
        const ScatteringCoordinates x =
            mapping_.coordinates(near.view, near.sun_cos_zenith, near.nu);
        const int u = nearest(x.x_nu, mapping_.nu_size()) * mapping_.sun_size() +
                      nearest(x.x_mu_s, mapping_.sun_size());
        const int v = mapping_.v_of(nearest(x.x_mu, mapping_.half_size()), x.meets_ground);
        const int w = nearest(x.x_r, mapping_.size()[2]);
        Direction at;
        at.view = mapping_.view_of_texel(v, w);
        at.sun_cos_zenith = mapping_.sun_of_texel(u);
        at.nu = mapping_.nu_of_texel(u);
        const FeasibleCosines feasible =
            feasible_cosines(view_cosine(mapping_.shell(), at.view), at.sun_cos_zenith);
        if (at.nu < feasible.low || at.nu > feasible.high) return {};
        Texel value{};
        for (std::size_t c = 0; c < table_.channels(); ++c) {
            value[c] = round_to_pixel_type(table_.channel(c)[table_.offset(u, v, w)], type_);
        }
        return errors(value, at);
    }

    std::string place_text(const Direction& at) const {
        return fmt::format(
            "altitude_km {:.4g}, cos_zenith {:.4g}{}, sun_cos_zenith {:.4g}, nu {:.4g}",
            at.view.altitude_km, view_cosine(mapping_.shell(), at.view),
            at.view.meets_ground ? " to the ground" : "", at.sun_cos_zenith, at.nu);
    }

  private:
    static int nearest(double x, int count) { return static_cast<int>(x * (count - 1) + 0.5); }

    std::vector<double> errors(const Texel& value, const Direction& at) const {
        const Texel wanted = exact_(at.view, at.sun_cos_zenith, at.nu);
        std::vector<double> result;
        for (std::size_t c = 0; c < table_.channels(); ++c) {
            result.push_back(relative_error(value[c], wanted[c], largest_[c]));
        }
        return result;
    }

    const DenseVolume& table_;
    const ScatteringMapping& mapping_;
    const ExactTexel& exact_;
    const std::vector<double>& largest_;
    config::PixelType type_;
};

}  // namespace

ExactTexel exact_texel(const ScatteringContent& content, const ScatteringReference& reference) {
    return [&content, &reference](const ScatteringView& view, double sun_cos_zenith, double nu) {
        return content.texel(reference.parts(view, sun_cos_zenith, nu));
    };
}

std::vector<double> largest_values(const DenseVolume& table) {
    std::vector<double> largest;
    for (std::size_t c = 0; c < table.channels(); ++c) largest.push_back(table.largest(c));
    return largest;
}

int scattering_points(Certification certification) {
    return certification == Certification::full ? kFullPoints : kQuickPoints;
}

Certificate measure_scattering(const DenseVolume& table, const ScatteringMapping& mapping,
                               const ExactTexel& exact, const std::vector<double>& largest,
                               config::PixelType type, int count, const BakeOptions& options) {
    const ScatteringErrors errors(table, mapping, exact, largest, type);
    std::vector<std::vector<double>> lookups(static_cast<std::size_t>(count));
    std::vector<std::vector<double>> texels(lookups.size());
    for_each_tile(count, options, "certify", [&](int i) {
        const Direction at = errors.direction(i);
        lookups[static_cast<std::size_t>(i)] = errors.lookup(at);
        texels[static_cast<std::size_t>(i)] = errors.texel(at);
    });
    Certificate certificate;
    ErrorStatistics lookup;
    ErrorStatistics texel;
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        for (const double error : lookups[at]) {
            if (std::fabs(error) > lookup.max()) {
                certificate.worst = errors.place_text(errors.direction(i));
            }
            lookup.add(error);
        }
        for (const double error : texels[at]) texel.add(error);
        certificate.texel_points += texels[at].empty() ? 0 : 1;
    }
    certificate.lookup_points = count;
    certificate.lookup = lookup.figures();
    certificate.texel = texel.figures();
    certificate.reference =
        "quadrature along each view ray, exact sunlight and transmittance, solved light";
    certificate.scale = kRelativeErrorScale;
    return certificate;
}

namespace {

SkyMedium scattering_where(SkyMedium medium, const std::vector<bool>& is_mie, bool wanted) {
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        if (is_mie[k] != wanted) medium.layers[k].scatters = false;
    }
    return medium;
}

}  // namespace

ScatteringReference::ScatteringReference(const SkyMedium& medium, const ScatteringContent& content,
                                         const HigherOrders* higher)
    : content_(content),
      air_(scattering_where(medium, content.is_mie(), false)),
      mie_(scattering_where(medium, content.is_mie(), true)),
      all_(medium, higher),
      air_alone_(air_, nullptr),
      mie_alone_(mie_, nullptr) {}

ScatteringParts ScatteringReference::parts(const ScatteringView& view, double sun_cos_zenith,
                                           double nu) const {
    const Shell shell = shell_of(air_.air);
    SkyRay ray;
    ray.altitude_km = view.altitude_km;
    ray.s_km = view.s_km;
    ray.length_km = view.length_km;
    ray.meets_ground = view.meets_ground;
    ray.sun_s_km = (shell.ground_radius_km + view.altitude_km) * sun_cos_zenith;
    ray.cosine_to_sun = nu;
    ray.one_minus_cosine = 1 - nu;
    ray.one_plus_cosine = 1 + nu;
    ScatteringParts parts;
    const Spectrum mie_phase = content_.mie_phase(nu);
    if (content_.wants_single()) {
        parts.air = air_alone_.up_to(ray, {ray.length_km}).front().single;
        parts.mie = mie_alone_.up_to(ray, {ray.length_km}).front().single;
    }
    if (content_.wants_higher()) parts.higher = all_.up_to(ray, {ray.length_km}).front().multiple;
    parts.air /= rayleigh_phase(nu);
    parts.higher /= rayleigh_phase(nu);
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        if (parts.mie[c] > 0) parts.mie[c] /= mie_phase[c];
    }
    return parts;
}

}  // namespace skybake
