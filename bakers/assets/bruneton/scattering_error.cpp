#include "bakers/assets/bruneton/scattering_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/bundle_light.h"
#include "bakers/field/certify.h"
#include "bakers/field/error_search.h"
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
    ScatteringErrors(const VoxelArray& table, const ScatteringMapping& mapping,
                     const ExactTexel& exact, const std::vector<double>& largest, PixelType type)
        : table_(table), mapping_(mapping), exact_(exact), largest_(largest), type_(type) {}

    Direction direction(int index) const {
        const std::array<double, 3> point = low_discrepancy_point(index);
        const double share = (index + 0.5) * kGoldenSection;
        return direction({point[1], point[2], 0}, {point[0], share - std::floor(share), 0});
    }

    // `view` is the view's place on its axis, the ground's half first, and x_r; `sun` is x_mu_s and
    // the share of the cosines to the sun that directions can have.
    Direction direction(const SearchPlace& view, const SearchPlace& sun) const {
        Direction result;
        result.view = mapping_.view(std::fabs(2 * view[0] - 1), view[0] < 0.5, view[1]);
        result.sun_cos_zenith = mapping_.sun_cos_zenith(sun[0]);
        const FeasibleCosines feasible =
            feasible_cosines(view_cosine(mapping_.shell(), result.view), result.sun_cos_zenith);
        result.nu = std::clamp(feasible.low + sun[1] * (feasible.high - feasible.low), -1.0, 1.0);
        return result;
    }

    // Returns the lookup's error in a direction, by channel.
    std::vector<double> lookup(const Direction& at) const { return errors(found(at), at); }

    // Writes the errors of lookups of one view against a row's values.
    void lookups(const TexelRow& row, const std::vector<Direction>& at, PointError* result) const {
        std::vector<double> suns;
        std::vector<double> nu;
        for (const Direction& direction : at) {
            suns.push_back(direction.sun_cos_zenith);
            nu.push_back(direction.nu);
        }
        const std::vector<Texel> wanted = row(at.front().view, suns, nu);
        for (std::size_t i = 0; i < at.size(); ++i) {
            const std::vector<double> each = errors(found(at[i]), wanted[i]);
            result[i] = PointError::of(each.data(), each.size());
        }
    }

    // Returns the error of lookups that the texels around a direction let expect: that of a value that
    // is off by an eighth of the second differences along all axes.
    double expected(const Direction& at) const {
        const ScatteringCoordinates x = mapping_.coordinates(at.view, at.sun_cos_zenith, at.nu);
        const std::array<int, 4> sizes = {mapping_.nu_size(), mapping_.sun_size(),
                                          mapping_.half_size(), mapping_.size()[2]};
        const std::array<double, 4> places = {x.x_nu, x.x_mu_s, x.x_mu, x.x_r};
        std::array<int, 4> texel{};
        for (std::size_t a = 0; a < 4; ++a) texel[a] = nearest(places[a], sizes[a]);
        double most = 0;
        for (std::size_t c = 0; c < table_.channels(); ++c) {
            const double value = value_of(texel, x.meets_ground, c);
            double off = 0;
            for (std::size_t a = 0; a < 4; ++a) {
                if (sizes[a] < 3) continue;
                std::array<int, 4> middle = texel;
                middle[a] = std::clamp(middle[a], 1, sizes[a] - 2);
                std::array<int, 4> before = middle;
                std::array<int, 4> after = middle;
                --before[a];
                ++after[a];
                off += std::fabs(value_of(before, x.meets_ground, c) -
                                 2 * value_of(middle, x.meets_ground, c) +
                                 value_of(after, x.meets_ground, c));
            }
            most = std::max(most, std::fabs(relative_error(value + off / 8, value, largest_[c])));
        }
        return most;
    }

    // Returns the errors of the texel next to the direction; none where the texel's nu is not feasible.
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

    Texel found(const Direction& at) const {
        return look_up(table_, mapping_, mapping_.coordinates(at.view, at.sun_cos_zenith, at.nu),
                       type_);
    }

    // `texel` holds the indices along nu, the sun, the view's half and the altitude.
    double value_of(const std::array<int, 4>& texel, bool meets_ground, std::size_t channel) const {
        return double{table_.channel(
            channel)[table_.offset(texel[0] * mapping_.sun_size() + texel[1],
                                   mapping_.v_of(texel[2], meets_ground), texel[3])]};
    }

    std::vector<double> errors(const Texel& value, const Direction& at) const {
        return errors(value, exact_(at.view, at.sun_cos_zenith, at.nu));
    }

    std::vector<double> errors(const Texel& value, const Texel& wanted) const {
        std::vector<double> result;
        for (std::size_t c = 0; c < table_.channels(); ++c) {
            result.push_back(relative_error(value[c], wanted[c], largest_[c]));
        }
        return result;
    }

    const VoxelArray& table_;
    const ScatteringMapping& mapping_;
    const ExactTexel& exact_;
    const std::vector<double>& largest_;
    PixelType type_;
};

// Rows, points in each, peak rows, climbs, and points of the reference.
constexpr SearchCounts kQuickSearch = {448, 56, 24, 6, 96};
constexpr SearchCounts kFullSearch = {1024, 256, 256, 32, 4096};

// Returns the edges of the cells of an axis whose end points are texel centres.
std::vector<double> edges_between(int texels) { return even_edges(std::max(texels - 1, 1)); }

// The cells of both halves of the view's axis, that of the ground, which runs backwards, first.
std::vector<double> view_edges(int half_size) {
    const std::vector<double> half = edges_between(half_size);
    std::vector<double> edges;
    for (auto x = half.rbegin(); x != half.rend(); ++x) edges.push_back(0.5 - 0.5 * *x);
    for (auto x = half.begin() + 1; x != half.end(); ++x) edges.push_back(0.5 + 0.5 * *x);
    return edges;
}

SkyMedium scattering_where(SkyMedium medium, const std::vector<bool>& is_mie, bool wanted) {
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        if (is_mie[k] != wanted) medium.layers[k].scatters = false;
    }
    return medium;
}

}  // namespace

ExactTexel exact_texel(const TableContent& content,
                       std::vector<const ScatteringReference*> references) {
    return [&content, references = std::move(references)](const ScatteringView& view,
                                                          double sun_cos_zenith, double nu) {
        std::vector<ScatteringParts> parts;
        for (const ScatteringReference* reference : references) {
            parts.push_back(reference->parts(view, sun_cos_zenith, nu));
        }
        return content.texel(parts, nu);
    };
}

std::vector<double> largest_values(const VoxelArray& table) {
    std::vector<double> largest;
    for (std::size_t c = 0; c < table.channels(); ++c) largest.push_back(table.largest(c));
    return largest;
}

int scattering_points(Certification certification) {
    return certification == Certification::full ? kFullPoints : kQuickPoints;
}

Certificate measure_scattering(const VoxelArray& table, const ScatteringMapping& mapping,
                               const ExactTexel& exact, const std::vector<double>& largest,
                               PixelType type, int count, const BakeOptions& options) {
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
            if (lookup.add(error)) certificate.worst = errors.place_text(errors.direction(i));
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

TexelRow texel_row(const TableContent& content, std::vector<const ScatteringRows*> rows) {
    return [&content, rows = std::move(rows)](const ScatteringView& view,
                                              const std::vector<double>& suns,
                                              const std::vector<double>& nu) {
        const SunBundle bundle(suns, nu);
        std::vector<ScatteringRow> packets;
        for (const ScatteringRows* each : rows) packets.push_back(each->row(view, bundle));
        std::vector<Texel> texels;
        std::vector<ScatteringParts> parts(packets.size());
        for (std::size_t i = 0; i < suns.size(); ++i) {
            for (std::size_t p = 0; p < packets.size(); ++p) {
                parts[p] = content.packets()[p]->parts(packets[p], i, nu[i]);
            }
            texels.push_back(content.texel(parts, nu[i]));
        }
        return texels;
    };
}

void search_scattering(const VoxelArray& table, const ScatteringMapping& mapping,
                       const ExactTexel& exact, const TexelRow& row,
                       const std::vector<double>& largest, PixelType type,
                       const BakeOptions& options, Certificate& certificate) {
    const ScatteringErrors errors(table, mapping, exact, largest, type);
    LookupSearch search = {
        SearchGrid({view_edges(mapping.half_size()), edges_between(mapping.size()[2])}),
        SearchGrid({edges_between(mapping.sun_size()), edges_between(mapping.nu_size())}),
        {},
        {},
        {}};
    search.exact = [&](const SearchPlace& view, const std::vector<SearchPlace>& suns,
                       PointError* result) {
        for (const SearchPlace& sun : suns) {
            const std::vector<double> each = errors.lookup(errors.direction(view, sun));
            *result++ = PointError::of(each.data(), each.size());
        }
    };
    search.estimate = [&](const SearchPlace& view, const std::vector<SearchPlace>& suns,
                          PointError* result) {
        std::vector<Direction> directions;
        for (const SearchPlace& sun : suns) directions.push_back(errors.direction(view, sun));
        errors.lookups(row, directions, result);
    };
    search.expected = [&](std::size_t view, std::size_t sun) {
        return errors.expected(
            errors.direction(search.rows.middle(view), search.points.middle(sun)));
    };
    const bool full = options.certification == Certification::full;
    const FoundErrors found = search_errors(search, full ? kFullSearch : kQuickSearch, options);
    certificate.lookup = found.figures;
    certificate.lookup_points = found.points;
    certificate.worst = errors.place_text(errors.direction(found.worst_row, found.worst_point));
}

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
