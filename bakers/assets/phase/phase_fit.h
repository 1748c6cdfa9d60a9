// Closed forms that replace a phase function, with the parameters for which the least light is
// scattered to other angles; and the scattering angles of a phase table's texels.
//
//   misplaced = 1/2 integral over directions |p_form - p|        a share of the light, in [0, 1]
//
//   henyey_greenstein         g
//   double_henyey_greenstein  w HG(g_1) + (1 - w) HG(g_2)         parameters g_1, g_2, w
//   cornette_shanks           g
//   draine                    g, alpha: HG times (1 + alpha nu^2) / (1 + alpha (1 + 2 g^2) / 3)
//                             (Draine 2003; alpha 0 is Henyey-Greenstein, 1 Cornette-Shanks)
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "bakers/air/particles/phase_function.h"
#include "bakers/air/particles/tabulated_phase.h"
#include "config/assets/phase.h"

namespace skybake {

struct PhaseFit {
    std::string_view form;           // as above
    std::vector<double> parameters;  // in the order above
    double misplaced = 0;            // share of the light
    double largest_ratio = 1;        // of the larger to the smaller of both, at any angle
};

// Returns one fit for each form, with the same bits on every machine.
std::vector<PhaseFit> fit_phase(const PhaseFunction& phase);

// Returns the names of a form's parameters.
std::vector<std::string_view> parameter_names(std::string_view form);

// Returns p of a form at an angle, in 1/sr.
double fitted_value(std::string_view form, const std::vector<double>& parameters,
                    double one_minus_cosine, double one_plus_cosine);

// The scattering angle of a texel of a phase table, for x in [0, 1] from straight on to straight
// back:
//
//   angle    theta = pi x
//   cosine   cos theta = 1 - 2 x
//   peaks    1 - cos theta = (2 x)^4 up to 90 degrees, 1 + cos theta = (2 - 2 x)^4 beyond: about
//            uniform in the square root of the angle from either pole

// The words for spacings in files, and back: none for another mapping. `best` has no word.
std::string_view spacing_name(config::PhaseSpacing spacing);
std::optional<config::PhaseSpacing> spacing_named(std::string_view mapping);

// For any spacing but `best`.
ScatteringAngle scattering_angle(config::PhaseSpacing spacing, double x);
double phase_coordinate(config::PhaseSpacing spacing, const ScatteringAngle& angle);

// The angle itself, in [0, pi].
double radians(const ScatteringAngle& angle);

}  // namespace skybake
