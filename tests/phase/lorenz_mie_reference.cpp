#include "tests/phase/lorenz_mie_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace skybake::test {
namespace {

using Real = long double;
using Complex = std::complex<Real>;

// psi_0 ... psi_count of z times an unknown factor: Miller's algorithm from far above |z|.
std::vector<Complex> miller(Complex z, int count) {
    const Real size = std::max(std::abs(z), Real(count));
    const int start = static_cast<int>(size + 25 * std::cbrt(size) + 50);
    std::vector<Complex> psi(static_cast<std::size_t>(start) + 2);
    psi[static_cast<std::size_t>(start)] = 1e-4000L;
    for (int n = start; n > 0; --n) {
        const auto i = static_cast<std::size_t>(n);
        psi[i - 1] = Real(2 * n + 1) / z * psi[i] - psi[i + 1];
        // Far from the poles only ratios count.
        if (std::abs(psi[i - 1]) > 1e4000L) {
            for (std::size_t j = i - 1; j < psi.size(); ++j) psi[j] *= 1e-4000L;
        }
    }
    psi.resize(static_cast<std::size_t>(count) + 1);
    return psi;
}

// psi_0 ... psi_count of a real x, by the larger of sin x and psi_1.
std::vector<Complex> psi_of(Real x, int count) {
    std::vector<Complex> psi = miller(x, count);
    const Real zeroth = std::sin(x);
    const Real first = std::sin(x) / x - std::cos(x);
    const Complex factor =
        std::abs(zeroth) > std::abs(first) ? zeroth / psi[0] : Complex(first) / psi[1];
    for (Complex& value : psi) value *= factor;
    return psi;
}

// xi = psi - i chi.
std::vector<Complex> xi_of(Real x, const std::vector<Complex>& psi) {
    std::vector<Real> chi = {std::cos(x), std::cos(x) / x + std::sin(x)};
    while (chi.size() < psi.size()) {
        const auto n = static_cast<Real>(chi.size());
        chi.push_back((2 * n - 1) / x * chi[chi.size() - 1] - chi[chi.size() - 2]);
    }
    std::vector<Complex> xi;
    for (std::size_t i = 0; i < psi.size(); ++i) xi.emplace_back(psi[i] - Complex(0, chi[i]));
    return xi;
}

// f_n' = f_(n-1) - n/z f_n of any Riccati-Bessel function.
Complex derivative(const std::vector<Complex>& f, std::size_t n, Complex z) {
    return f[n - 1] - Real(n) / z * f[n];
}

struct Series {
    std::vector<Complex> a, b;  // from n = 1
};

Series series_of(Real x, Complex m) {
    const int count = static_cast<int>(x + 9 * std::cbrt(x) + 8);
    const Complex y = m * x;
    const std::vector<Complex> inside = miller(y, count);
    const std::vector<Complex> psi = psi_of(x, count);
    const std::vector<Complex> xi = xi_of(x, psi);
    Series series;
    for (std::size_t n = 1; n <= static_cast<std::size_t>(count); ++n) {
        const Complex d_inside = derivative(inside, n, y);
        const Complex d_psi = derivative(psi, n, x);
        const Complex d_xi = derivative(xi, n, x);
        series.a.push_back((d_inside * psi[n] - m * inside[n] * d_psi) /
                           (d_inside * xi[n] - m * inside[n] * d_xi));
        series.b.push_back((m * d_inside * psi[n] - inside[n] * d_psi) /
                           (m * d_inside * xi[n] - inside[n] * d_xi));
    }
    return series;
}

void add_angle(const Series& series, Real cosine, ReferenceSphere& result) {
    Complex s1 = 0;
    Complex s2 = 0;
    Real pi = 1;
    Real before = 0;
    for (std::size_t i = 0; i < series.a.size(); ++i) {
        const auto n = static_cast<Real>(i + 1);
        const Real tau = n * cosine * pi - (n + 1) * before;
        const Real c = (2 * n + 1) / (n * (n + 1));
        s1 += c * (series.a[i] * pi + series.b[i] * tau);
        s2 += c * (series.a[i] * tau + series.b[i] * pi);
        const Real next = ((2 * n + 1) * cosine * pi - (n + 1) * before) / n;
        before = pi;
        pi = next;
    }
    result.perpendicular.push_back(static_cast<double>(std::norm(s1)));
    result.parallel.push_back(static_cast<double>(std::norm(s2)));
}

}  // namespace

ReferenceSphere reference_sphere(double size_parameter, std::complex<double> refractive_index,
                                 const std::vector<double>& cosines) {
    const Real x = size_parameter;
    const Series series = series_of(x, Complex(refractive_index));
    const auto& [a, b] = series;
    Real extinction = 0;
    Real scattering = 0;
    Real along = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto n = static_cast<Real>(i + 1);
        extinction += (2 * n + 1) * (a[i] + b[i]).real();
        scattering += (2 * n + 1) * (std::norm(a[i]) + std::norm(b[i]));
        along += (2 * n + 1) / (n * (n + 1)) * (a[i] * std::conj(b[i])).real();
        if (i + 1 == a.size()) break;
        along += n * (n + 2) / (n + 1) *
                 (a[i] * std::conj(a[i + 1]) + b[i] * std::conj(b[i + 1])).real();
    }
    ReferenceSphere result;
    add_angle(series, -1, result);
    result.backscatter = static_cast<double>(4 / (x * x)) * result.perpendicular.front();
    result.perpendicular.clear();
    result.parallel.clear();
    result.extinction = static_cast<double>(2 / (x * x) * extinction);
    result.scattering = static_cast<double>(2 / (x * x) * scattering);
    result.mean_cosine = static_cast<double>(2 * along / scattering);
    for (const double cosine : cosines) add_angle(series, cosine, result);
    return result;
}

}  // namespace skybake::test
