#include "bakers/assets/phase/phase_fit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "bakers/math/transcendental.h"
#include "config/fields/fields.h"

namespace skybake {
namespace {

using config::PhaseSpacing;

struct Range {
    double low = 0;
    double high = 0;
};

constexpr Range kAsymmetry = {-0.9999, 0.9999};

struct Form {
    std::string_view name;
    std::vector<std::string_view> parameters;
    std::vector<Range> ranges;
    std::vector<std::vector<double>> starts;
    double (*value)(const std::vector<double>& parameters, double one_minus, double one_plus);
};

const std::vector<Form>& forms() {
    static const std::vector<Form> all = {
        {"henyey_greenstein",
         {"g"},
         {kAsymmetry},
         {{-0.9}, {-0.5}, {0.0}, {0.5}, {0.9}, {0.98}, {0.999}},
         [](const std::vector<double>& p, double one_minus, double one_plus) {
             return henyey_greenstein(p[0], one_minus, one_plus);
         }},
        {"double_henyey_greenstein",
         {"g_1", "g_2", "w"},
         {kAsymmetry, kAsymmetry, {0, 1}},
         {{0.5, -0.5, 0.5}, {0.9, -0.3, 0.9}, {0.98, 0.6, 0.5}, {0.8, 0.3, 0.7}, {0.999, 0.7, 0.5}},
         [](const std::vector<double>& p, double one_minus, double one_plus) {
             return p[2] * henyey_greenstein(p[0], one_minus, one_plus) +
                    (1 - p[2]) * henyey_greenstein(p[1], one_minus, one_plus);
         }},
        {"cornette_shanks",
         {"g"},
         {kAsymmetry},
         {{-0.9}, {-0.5}, {0.0}, {0.5}, {0.9}, {0.98}, {0.999}},
         [](const std::vector<double>& p, double one_minus, double one_plus) {
             return draine(p[0], 1, one_minus, one_plus);
         }},
        {"draine",
         {"g", "alpha"},
         {kAsymmetry, {0, 1000}},
         {{0.0, 0.5}, {0.5, 0.5}, {0.9, 1}, {0.6, 100}, {0.98, 0}, {0.999, 0}},
         [](const std::vector<double>& p, double one_minus, double one_plus) {
             return draine(p[0], p[1], one_minus, one_plus);
         }},
    };
    return all;
}

const Form& form_named(std::string_view name) {
    const auto found = std::ranges::find(forms(), name, &Form::name);
    assert(found != forms().end());
    return *found;
}

// The function at nodes of a trapezoidal rule over directions, clustered at the poles.
struct Node {
    ScatteringAngle angle;
    double weight = 0;  // solid angle
    double value = 0;
};

std::vector<Node> make_nodes(const PhaseFunction& phase) {
    constexpr int kCells = 512;
    std::vector<Node> nodes;
    for (int i = 0; i <= kCells; ++i) {
        Node node;
        node.angle = scattering_angle(config::PhaseSpacing::peaks, double(i) / kCells);
        node.value = phase_value(phase, node.angle.one_minus, node.angle.one_plus);
        nodes.push_back(node);
    }
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        // From the pole where the difference keeps its digits.
        const bool forward = nodes[i + 1].angle.one_minus <= 1;
        const double width = forward ? nodes[i + 1].angle.one_minus - nodes[i].angle.one_minus
                                     : nodes[i].angle.one_plus - nodes[i + 1].angle.one_plus;
        nodes[i].weight += std::numbers::pi * width;
        nodes[i + 1].weight += std::numbers::pi * width;
    }
    return nodes;
}

double misplaced(const Form& form, const std::vector<double>& parameters,
                 const std::vector<Node>& nodes) {
    double sum = 0;
    for (const Node& node : nodes) {
        sum += node.weight *
               std::fabs(form.value(parameters, node.angle.one_minus, node.angle.one_plus) -
                         node.value);
    }
    return 0.5 * sum;
}

// How far a parameter goes at a time: asymmetries by their distance from 1, which is how wide their
// lobe is; alpha by factors of itself.
double scale_of(const Range& range, double value) {
    if (range.low < 0) return 1 - std::fabs(value);
    return range.high > 1 ? 1 + value : 1;
}

// Compass search (Hooke & Jeeves 1961): along each parameter by a step that halves when none helps.
// Comparisons of sums of products alone, so that it ends at the same bits everywhere.
struct Minimum {
    std::vector<double> at;
    double value = 0;
};

Minimum search(const Form& form, std::vector<double> at, const std::vector<Node>& nodes) {
    Minimum best = {at, misplaced(form, at, nodes)};
    for (double step = 0.25; step > 1e-4;) {
        bool better = false;
        for (std::size_t i = 0; i < at.size(); ++i) {
            for (const double sign : {1.0, -1.0}) {
                std::vector<double> next = best.at;
                const Range& range = form.ranges[i];
                const double length = step * scale_of(range, next[i]);
                next[i] = std::clamp(next[i] + sign * length, range.low, range.high);
                const double value = misplaced(form, next, nodes);
                if (!(value < best.value)) continue;
                best = {std::move(next), value};
                better = true;
            }
        }
        if (!better) step *= 0.5;
    }
    return best;
}

const config::Field& spacing_field() {
    return *config::find_field(*config::find_section("bake.*", "phase"), "spacing");
}

double fourth_root(double x) { return std::sqrt(std::sqrt(x)); }

}  // namespace

std::vector<PhaseFit> fit_phase(const PhaseFunction& phase) {
    const std::vector<Node> nodes = make_nodes(phase);
    std::vector<PhaseFit> fits;
    for (const Form& form : forms()) {
        Minimum best = search(form, form.starts.front(), nodes);
        for (std::size_t i = 1; i < form.starts.size(); ++i) {
            Minimum other = search(form, form.starts[i], nodes);
            if (other.value < best.value) best = std::move(other);
        }
        PhaseFit fit = {form.name, best.at, best.value, 1};
        for (const Node& node : nodes) {
            const double ratio =
                form.value(best.at, node.angle.one_minus, node.angle.one_plus) / node.value;
            fit.largest_ratio = std::max({fit.largest_ratio, ratio, 1 / ratio});
        }
        fits.push_back(std::move(fit));
    }
    return fits;
}

std::vector<std::string_view> parameter_names(std::string_view form) {
    return form_named(form).parameters;
}

double fitted_value(std::string_view form, const std::vector<double>& parameters,
                    double one_minus_cosine, double one_plus_cosine) {
    return form_named(form).value(parameters, one_minus_cosine, one_plus_cosine);
}

std::string_view spacing_name(PhaseSpacing spacing) {
    return config::choice_name(spacing_field(), spacing);
}

std::optional<PhaseSpacing> spacing_named(std::string_view mapping) {
    for (const config::Choice& choice : spacing_field().choices) {
        if (choice.name == mapping) return static_cast<PhaseSpacing>(choice.enumerator);
    }
    return std::nullopt;
}

ScatteringAngle scattering_angle(PhaseSpacing spacing, double x) {
    if (spacing == PhaseSpacing::angle) {
        // 1 - cos theta = 2 sin^2(theta / 2).
        const double sine = cosine_of_pi(0.5 * std::fabs(1 - x));
        const double cosine = cosine_of_pi(0.5 * x);
        return {2 * sine * sine, 2 * cosine * cosine};
    }
    if (spacing == PhaseSpacing::cosine) return {2 * x, 2 * (1 - x)};
    if (spacing == PhaseSpacing::cosine_from_back) return {2 * (1 - x), 2 * x};
    const double w = x <= 0.5 ? 2 * x : 2 * (1 - x);
    const double from_pole = w * w * w * w;
    return x <= 0.5 ? ScatteringAngle{from_pole, 2 - from_pole}
                    : ScatteringAngle{2 - from_pole, from_pole};
}

double phase_coordinate(PhaseSpacing spacing, const ScatteringAngle& angle) {
    if (spacing == PhaseSpacing::angle) return radians(angle) / std::numbers::pi;
    if (spacing == PhaseSpacing::cosine) return 0.5 * angle.one_minus;
    if (spacing == PhaseSpacing::cosine_from_back) return 0.5 * angle.one_plus;
    return angle.one_minus <= angle.one_plus ? 0.5 * fourth_root(angle.one_minus)
                                             : 1 - 0.5 * fourth_root(angle.one_plus);
}

double radians(const ScatteringAngle& angle) {
    // From the nearer pole, twice the arc sine of half the chord; pi / 2 - acos of it loses digits
    // of small angles, the arc cosine of its complement does not.
    const bool forward = angle.one_minus <= angle.one_plus;
    const double near = forward ? angle.one_minus : angle.one_plus;
    const double half_sine = std::sqrt(0.5 * near);
    // asin x = x + x^3 / 6 + 3 x^5 / 40 ...: below 1e-3 the third term is below 1e-16.
    const double half = half_sine < 1e-3 ? half_sine * (1 + half_sine * half_sine / 6)
                                         : 0.5 * std::numbers::pi - arc_cosine(half_sine);
    return forward ? 2 * half : std::numbers::pi - 2 * half;
}

}  // namespace skybake
