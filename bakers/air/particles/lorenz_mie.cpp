#include "bakers/air/particles/lorenz_mie.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

double cube_root(double x) { return exponential(logarithm(x) / 3); }

// How far above n = max(count, |z|) a downward recurrence starts: by the same exponent with c = 7.5
// what the start is off has shrunk to 2e-17 at n = |z|.
int start_margin(double z) { return static_cast<int>(7.5 * cube_root(z) + 10); }

}  // namespace

int mie_term_count(double x) {
    // Beyond n = x the amplitudes fall as psi_n / chi_n: at n = x + c x^(1/3) as exp(-4 sqrt(2) / 3
    // c^(3/2)) (Airy's functions, Abramowitz & Stegun 9.3.23). Wiscombe's c = 4.05 (1980) leaves
    // amplitudes of 1e-7, enough for cross-sections, which have their squares; 5.5 leaves 3e-11, so
    // that dark angles are right too. Three more for x < 1, where x^(2 n + 1) falls fast.
    return static_cast<int>(x + 5.5 * cube_root(x) + 3);
}

MieSteps mie_steps(double x, ComplexNumber refractive_index) {
    MieSteps steps;
    steps.count = mie_term_count(x);
    steps.upward = std::min(steps.count, static_cast<int>(x));
    steps.start_of_ratios = steps.count + start_margin(std::max(x, 1.0));
    const double size = std::sqrt(squared_modulus(x * refractive_index));
    const double largest = std::max(size, static_cast<double>(steps.count));
    steps.start_of_slopes = static_cast<int>(largest) + start_margin(largest);
    return steps;
}

}  // namespace skybake
