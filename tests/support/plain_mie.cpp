#include "tests/support/plain_mie.h"

#include <cassert>

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// D_1 ... D_count of z, by D_(n-1) = n/z - 1 / (D_n + n/z), from D_n = (n + 1)/z.
std::vector<ComplexNumber> logarithmic_derivatives(ComplexNumber z, int count, int start) {
    const ComplexNumber per_z = inverse(z);
    std::vector<ComplexNumber> result(static_cast<std::size_t>(count));
    ComplexNumber d = (start + 1.0) * per_z;
    for (int n = start; n > 1; --n) {
        const ComplexNumber n_per_z = n * per_z;
        d = n_per_z - inverse(d + n_per_z);
        if (n - 1 <= count) result[static_cast<std::size_t>(n - 2)] = d;
    }
    return result;
}

// psi_0 ... psi_count of x.
std::vector<double> riccati_bessel(double x, const MieSteps& steps, const SineCosine& at_x) {
    const auto [count, upward, start, start_of_slopes] = steps;
    std::vector<double> psi = {at_x.sine};
    psi.reserve(static_cast<std::size_t>(count) + 1);
    double before = at_x.cosine;
    for (int n = 0; n < upward; ++n) {
        const double next = (2 * n + 1) / x * psi.back() - before;
        before = psi.back();
        psi.push_back(next);
    }
    // psi_(n-1) / psi_n for the others, from downwards.
    std::vector<double> ratios(static_cast<std::size_t>(count - upward));
    double ratio = (2 * start + 1) / x;
    for (int n = start - 1; n > upward; --n) {
        ratio = (2 * n + 1) / x - 1 / ratio;
        if (n <= count) ratios[static_cast<std::size_t>(n - upward - 1)] = ratio;
    }
    for (const double r : ratios) psi.push_back(psi.back() / r);
    return psi;
}

// psi and chi of x at n and n - 1.
struct RadialPair {
    double psi, psi_before;
    double chi, chi_before;
};

struct Amplitude {
    ComplexNumber value;  // a_n or b_n
    double absorbed = 0;  // Re value - |value|^2
};

// With `slope` the A of the header.
Amplitude amplitude(ComplexNumber slope, double n_per_x, const RadialPair& at) {
    const ComplexNumber factor = {slope.real + n_per_x, slope.imaginary};
    const ComplexNumber p = {factor.real * at.psi - at.psi_before, factor.imaginary * at.psi};
    const ComplexNumber q = {factor.real * at.chi - at.chi_before, factor.imaginary * at.chi};
    const ComplexNumber denominator = {p.real + q.imaginary, p.imaginary - q.real};  // p - i q
    const double per_square = 1 / squared_modulus(denominator);
    return {per_square * (p * conjugate(denominator)), -slope.imaginary * per_square};
}

}  // namespace

MieCoefficients mie_coefficients(double size_parameter, ComplexNumber refractive_index) {
    assert(size_parameter > 0 && squared_modulus(refractive_index) > 0);
    const double x = size_parameter;
    const MieSteps steps = mie_steps(x, refractive_index);
    const SineCosine at_x = sine_and_cosine(x);
    const auto derivatives =
        logarithmic_derivatives(x * refractive_index, steps.count, steps.start_of_slopes);
    const std::vector<double> psi = riccati_bessel(x, steps, at_x);
    const ComplexNumber per_index = inverse(refractive_index);
    MieCoefficients result;
    result.size_parameter = x;
    result.a.reserve(derivatives.size());
    result.b.reserve(derivatives.size());
    double chi = at_x.cosine;
    double chi_before = -at_x.sine;
    double absorbed = 0;
    for (int n = 1; n <= steps.count; ++n) {
        const double next = (2 * n - 1) / x * chi - chi_before;
        chi_before = chi;
        chi = next;
        const auto i = static_cast<std::size_t>(n);
        const RadialPair at = {psi[i], psi[i - 1], chi, chi_before};
        const Amplitude a = amplitude(per_index * derivatives[i - 1], n / x, at);
        const Amplitude b = amplitude(refractive_index * derivatives[i - 1], n / x, at);
        result.a.push_back(a.value);
        result.b.push_back(b.value);
        absorbed += (2 * n + 1) * (a.absorbed + b.absorbed);
    }
    // Rounding may leave a negative remainder where nothing is absorbed.
    result.absorption_efficiency = refractive_index.imaginary > 0 ? 2 / x / x * absorbed : 0.0;
    return result;
}

MieEfficiencies mie_efficiencies(const MieCoefficients& coefficients) {
    const auto& [x, a, b, absorption] = coefficients;
    double scattered = 0;
    double along = 0;
    ComplexNumber back;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double n = static_cast<double>(i) + 1;
        scattered += (2 * n + 1) * (squared_modulus(a[i]) + squared_modulus(b[i]));
        along += (2 * n + 1) / (n * (n + 1)) * (a[i] * conjugate(b[i])).real;
        if (i + 1 < a.size()) {
            along += n * (n + 2) / (n + 1) *
                     (a[i] * conjugate(a[i + 1]) + b[i] * conjugate(b[i + 1])).real;
        }
        back = back + (i % 2 == 0 ? -1 : 1) * (2 * n + 1) * (a[i] - b[i]);
    }
    MieEfficiencies result;
    result.scattering = 2 / x / x * scattered;
    result.absorption = absorption;
    result.extinction = result.scattering + absorption;
    result.backscatter = squared_modulus(back) / x / x;
    result.mean_cosine = 2 * along / scattered;
    return result;
}

MieTerms mie_terms(const MieCoefficients& coefficients) {
    MieTerms terms;
    terms.reserve(coefficients.a.size());
    for (std::size_t i = 0; i < coefficients.a.size(); ++i) {
        const double n = static_cast<double>(i + 1);
        const double c = (2 * n + 1) / (n * (n + 1));
        const double even = i % 2 == 1 ? -1 : 1;
        const ComplexNumber sum = c * (coefficients.a[i] + coefficients.b[i]);
        const ComplexNumber difference = c * (coefficients.a[i] - coefficients.b[i]);
        terms.push_back(
            {sum.real, sum.imaginary, even * difference.real, even * difference.imaginary});
    }
    return terms;
}

}  // namespace skybake
