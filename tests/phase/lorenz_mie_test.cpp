#include "bakers/air/particles/lorenz_mie.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "bakers/math/quadrature.h"
#include "tests/phase/lorenz_mie_reference.h"
#include "tests/phase/one_sphere.h"
#include "tests/support/every_target.h"

namespace skybake {
namespace {

struct Sphere {
    double n, k, x;
};

test::MieSphere made_of(const Sphere& sphere) {
    return test::mie_sphere(sphere.x, {sphere.n, sphere.k});
}
MieEfficiencies efficiencies_of(const Sphere& sphere) { return made_of(sphere).efficiencies; }

TEST(LorenzMie, SphereOfBohrenAndHuffman) {
    const double x = 2 * std::numbers::pi * 0.525 / 0.6328;
    const test::MieSphere sphere = made_of({1.55, 0, x});
    const MieEfficiencies& q = sphere.efficiencies;
    EXPECT_NEAR(q.extinction, 3.10543, 5e-6);
    EXPECT_NEAR(q.scattering, 3.10543, 5e-6);
    EXPECT_NEAR(sphere.backscatter(), 2.92534, 5e-6);
    EXPECT_NEAR(q.mean_cosine, 0.63314, 5e-6);
}

// Wiscombe 1979, Mie Scattering Calculations (NCAR/TN-140+STR), test cases of MIEV0 as published,
// to their last digit.
TEST(LorenzMie, SpheresOfWiscombe) {
    struct Published {
        Sphere sphere;
        double scattering, mean_cosine, digit;
    };
    for (const auto& [sphere, scattering, mean_cosine, digit] :
         std::initializer_list<Published>{{{0.75, 0, 0.099}, 0.000007, 0.001448, 1e-6},
                                          {{0.75, 0, 0.101}, 0.000008, 0.001507, 1e-6},
                                          {{0.75, 0, 10}, 2.232265, 0.896473, 1e-6},
                                          {{0.75, 0, 1000}, 1.997908, 0.844944, 1e-6},
                                          {{1.33, 1e-5, 1}, 0.093923, 0.184517, 1e-6},
                                          {{1.33, 1e-5, 100}, 2.096594, 0.868959, 1e-6},
                                          {{1.33, 1e-5, 10000}, 1.723857, 0.907840, 1e-6},
                                          {{1.5, 1, 0.055}, 0.000011, 0.000491, 1e-6},
                                          {{1.5, 1, 0.056}, 0.000012, 0.000509, 1e-6},
                                          {{1.5, 1, 1}, 0.663454, 0.192136, 1e-6},
                                          {{1.5, 1, 100}, 1.283697, 0.850252, 1e-6},
                                          {{1.5, 1, 10000}, 1.236575, 0.846310, 1.1e-6},
                                          {{10, 10, 1}, 2.049405, -0.110664, 1e-6},
                                          {{10, 10, 100}, 1.836785, 0.556215, 1e-6},
                                          {{10, 10, 10000}, 1.795393, 0.548194, 1e-6}}) {
        const MieEfficiencies q = efficiencies_of(sphere);
        EXPECT_NEAR(q.scattering, scattering, digit) << sphere.n << ' ' << sphere.x;
        EXPECT_NEAR(q.mean_cosine, mean_cosine, digit) << sphere.n << ' ' << sphere.x;
    }
    EXPECT_NEAR(efficiencies_of({1.5, 1, 0.055}).extinction, 0.101491, 5e-7);
    EXPECT_NEAR(efficiencies_of({1.5, 1, 100}).extinction, 2.097502, 5e-7);
    EXPECT_NEAR(efficiencies_of({1.5, 1, 10000}).extinction, 2.004368, 5e-7);
    // Values of the older program, with four decimals.
    EXPECT_NEAR(efficiencies_of({1.5, 0, 10}).scattering, 2.8820, 5e-5);
    EXPECT_NEAR(efficiencies_of({1.5, 0, 100}).scattering, 2.0944, 5e-5);
    EXPECT_NEAR(efficiencies_of({1.5, 0, 1000}).scattering, 2.0139, 5e-5);
    EXPECT_NEAR(efficiencies_of({1.5, 0, 5000}).scattering, 2.0086, 5e-5);
}

// Amplitudes of m = 1.5 + i, x = 1 from the same report, every 30 degrees.
TEST(LorenzMie, AmplitudesOfWiscombe) {
    const std::array<std::complex<double>, 7> s1 = {{{0.584080, 0.190515},
                                                     {0.565702, 0.187200},
                                                     {0.517525, 0.178443},
                                                     {0.456340, 0.167167},
                                                     {0.400212, 0.156643},
                                                     {0.362157, 0.149391},
                                                     {0.348844, 0.146829}}};
    const std::array<std::complex<double>, 7> s2 = {{{0.584080, 0.190515},
                                                     {0.500161, 0.145611},
                                                     {0.287964, 0.041054},
                                                     {0.0362285, -0.0618265},
                                                     {-0.174875, -0.122959},
                                                     {-0.305682, -0.143846},
                                                     {-0.348844, -0.146829}}};
    std::vector<double> one_minus;
    for (int i = 0; i < 4; ++i) one_minus.push_back(1 - std::cos(i * std::numbers::pi / 6));
    const MieIntensities at = made_of({1.5, 1, 1}).intensities(one_minus);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(at.perpendicular[i], std::norm(s1[i]), 2e-6) << i;
        EXPECT_NEAR(at.parallel[i], std::norm(s2[i]), 2e-6) << i;
        EXPECT_NEAR(at.back_perpendicular[i], std::norm(s1[6 - i]), 2e-6) << i;
        EXPECT_NEAR(at.back_parallel[i], std::norm(s2[6 - i]), 2e-6) << i;
    }
}

double power_of_ten(double exponent) { return std::pow(10.0, exponent); }

Sphere any_sphere(int thousandths_of_decades) {
    const double x = power_of_ten(*rc::gen::inRange(-3000, thousandths_of_decades) / 1000.0);
    const double n = *rc::gen::element(0.02, 0.5, 0.75, 1.01, 1.33, 1.5, 2.5, 8.0, 40.0);
    const bool absorbs = *rc::gen::arbitrary<bool>();
    const double k = absorbs ? power_of_ten(*rc::gen::inRange(-9000, 2000) / 1000.0) : 0.0;
    return {n, k, x};
}

// Relative to the value itself, however dark the angle, and 1e-13 of the brightest.
RC_GTEST_PROP(LorenzMie, IsTheReference, ()) {
    const Sphere sphere = any_sphere(3700);
    std::vector<double> one_minus = {0, 1e-9, 1e-5, 0.004, 0.3, 0.7, 0.95, 1};
    std::vector<double> cosines;
    for (const double v : one_minus) cosines.push_back(1 - v);
    for (const double v : one_minus) cosines.push_back(v - 1);
    const test::ReferenceSphere wanted =
        test::reference_sphere(sphere.x, {sphere.n, sphere.k}, cosines);
    const test::MieSphere found = made_of(sphere);
    const MieEfficiencies& q = found.efficiencies;
    const auto near = [](double value, double expected, double relative, double absolute) {
        return std::fabs(value - expected) <= relative * std::fabs(expected) + absolute;
    };
    RC_ASSERT(near(q.extinction, wanted.extinction, 1e-8, 0));
    RC_ASSERT(near(q.scattering, wanted.scattering, 1e-8, 0));
    RC_ASSERT(near(found.backscatter(), wanted.backscatter, 1e-6, 0));
    RC_ASSERT(near(q.mean_cosine, wanted.mean_cosine, 1e-8, 1e-11));
    const MieIntensities at = found.intensities(one_minus);
    const double dark = 1e-13 * wanted.perpendicular[0];
    for (std::size_t i = 0; i < one_minus.size(); ++i) {
        const std::size_t back = i + one_minus.size();
        RC_ASSERT(near(at.perpendicular[i], wanted.perpendicular[i], 1e-6, dark));
        RC_ASSERT(near(at.parallel[i], wanted.parallel[i], 1e-6, dark));
        RC_ASSERT(near(at.back_perpendicular[i], wanted.perpendicular[back], 1e-6, dark));
        RC_ASSERT(near(at.back_parallel[i], wanted.parallel[back], 1e-6, dark));
    }
}

RC_GTEST_PROP(LorenzMie, ScattersNoMoreThanItTakes, ()) {
    const test::MieSphere sphere = made_of(any_sphere(3500));
    const MieEfficiencies& q = sphere.efficiencies;
    RC_ASSERT(q.absorption >= 0);
    RC_ASSERT(q.scattering <= q.extinction);
    RC_ASSERT(std::fabs(q.mean_cosine) < 1);
    // The optical theorem: two sums that share nothing but the coefficients.
    const double by_theorem =
        4 / (sphere.size_parameter * sphere.size_parameter) * sphere.at_pole(0).real();
    RC_ASSERT(std::fabs(by_theorem - q.extinction) <= 1e-11 * q.extinction);
}

// The light that goes into all directions is Q_sca, and its mean cosine g.
RC_GTEST_PROP(LorenzMie, IntensitiesAddUpToTheCrossSection, ()) {
    const Sphere sphere = any_sphere(1500);
    const test::MieSphere found = made_of(sphere);
    const MieEfficiencies& q = found.efficiencies;
    const QuadratureRule rule = gauss_legendre(static_cast<int>(found.terms.size()) + 2);
    const MieIntensities at = found.intensities(rule.nodes);
    double sum = 0;
    double along = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double ahead = at.perpendicular[i] + at.parallel[i];
        const double back = at.back_perpendicular[i] + at.back_parallel[i];
        sum += rule.weights[i] * (ahead + back);
        along += rule.weights[i] * (1 - rule.nodes[i]) * (ahead - back);
    }
    RC_ASSERT(std::fabs(sum / (sphere.x * sphere.x) - q.scattering) < 1e-11 * q.scattering);
    RC_ASSERT(std::fabs(along / sum - q.mean_cosine) < 1e-11);
}

TEST(LorenzMie, TinySpheresScatterAsRayleighs) {
    for (const double x : {1e-8, 1e-6, 1e-4, 1e-3}) {
        for (const std::complex<double> m : {std::complex<double>(1.33, 0), {1.5, 0.3}, {3, 4}}) {
            const std::complex<double> polarisability = (m * m - 1.0) / (m * m + 2.0);
            const MieEfficiencies q = efficiencies_of({m.real(), m.imag(), x});
            const double scattering = 8.0 / 3 * x * x * x * x * std::norm(polarisability);
            const double absorption = 4 * x * polarisability.imag();
            const double order = 5 * std::norm(m) * x * x + 1e-13;
            EXPECT_NEAR(q.scattering, scattering, order * scattering) << x << m;
            EXPECT_NEAR(q.absorption, absorption, order * absorption + 1e-30) << x << m;
            EXPECT_NEAR(q.mean_cosine, 0, order) << x << m;
        }
    }
    const MieIntensities at = made_of({1.33, 0, 1e-6}).intensities({0, 0.5, 1});
    EXPECT_NEAR(at.parallel[1] / at.perpendicular[1], 0.25, 1e-11);
    EXPECT_NEAR(at.perpendicular[1] / at.back_perpendicular[0], 1, 1e-11);
    EXPECT_LT(at.parallel[2], 1e-20 * at.perpendicular[2]);
}

// Twice the shadow, and the edge's 1.99 x^(-2/3) (van de Hulst 1957, 17.2) on top.
TEST(LorenzMie, HugeSpheresTakeTwiceTheirShadow) {
    for (const double k : {1e-9, 0.1}) {
        for (const double x : {1e4, 1e5, 3e5}) {
            const double edge = std::pow(x, -2.0 / 3);
            EXPECT_NEAR(efficiencies_of({1.33, k, x}).extinction, 2 + 2 * edge, 0.4 * edge) << x;
        }
    }
}

TEST(LorenzMie, HugeSpheresKeepTheirDigits) {
    const std::vector<double> one_minus = {0, 1e-9, 0.01, 0.5, 1};
    std::vector<double> cosines;
    for (const double v : one_minus) cosines.push_back(1 - v);
    for (const double v : one_minus) cosines.push_back(v - 1);
    const test::ReferenceSphere wanted = test::reference_sphere(1e5, {1.333, 1e-6}, cosines);
    const test::MieSphere sphere = made_of({1.333, 1e-6, 1e5});
    const MieEfficiencies& q = sphere.efficiencies;
    EXPECT_NEAR(q.extinction, wanted.extinction, 1e-12);
    EXPECT_NEAR(q.scattering, wanted.scattering, 1e-12);
    EXPECT_NEAR(q.mean_cosine, wanted.mean_cosine, 1e-12);
    const MieIntensities at = sphere.intensities(one_minus);
    for (std::size_t i = 0; i < one_minus.size(); ++i) {
        const std::size_t back = i + one_minus.size();
        EXPECT_NEAR(at.perpendicular[i] / wanted.perpendicular[i], 1, 1e-6) << i;
        EXPECT_NEAR(at.parallel[i] / wanted.parallel[i], 1, 1e-6) << i;
        EXPECT_NEAR(at.back_perpendicular[i] / wanted.perpendicular[back], 1, 1e-6) << i;
        EXPECT_NEAR(at.back_parallel[i] / wanted.parallel[back], 1, 1e-6) << i;
    }
}

TEST(LorenzMie, StrongAbsorptionKeepsFresnelsReflection) {
    // Light that is not diffracted is reflected off an opaque sphere, straight back at normal
    // incidence.
    for (const std::complex<double> m : {std::complex<double>(1.5, 1), {10, 10}, {0.2, 30}}) {
        const double reflected = std::norm((m - 1.0) / (m + 1.0));
        EXPECT_NEAR(made_of({m.real(), m.imag(), 5e4}).backscatter(), reflected, 1e-4 * reflected)
            << m;
    }
}

TEST(LorenzMie, WeakAbsorptionIsNotADifference) {
    for (const double x : {0.01, 1.0, 30.0, 1000.0}) {
        const double least = efficiencies_of({1.33, 1e-16, x}).absorption;
        const double more = efficiencies_of({1.33, 1e-11, x}).absorption;
        EXPECT_NEAR(more / least, 1e5, 10) << x;
    }
}

// Anomalous diffraction: van de Hulst 1957, 11.22; the edge of the sphere refracts after all.
TEST(LorenzMie, IndexNearOneIsAnomalousDiffraction) {
    for (const double excess : {1e-3, 1e-4}) {
        for (const double lag : {0.5, 4.0, 10.0}) {
            const double expected =
                2 - 4 / lag * std::sin(lag) + 4 / (lag * lag) * (1 - std::cos(lag));
            EXPECT_NEAR(efficiencies_of({1 + excess, 0, lag / (2 * excess)}).extinction, expected,
                        0.02 * expected)
                << excess << ' ' << lag;
        }
    }
    // Below, by Rayleigh and Gans: the phase lag squared, halved.
    EXPECT_NEAR(efficiencies_of({1 + 1e-9, 0, 1e5}).extinction, 2e-8, 1e-11);
}

TEST(LorenzMie, ResonancesScatterWhatTheyTake) {
    // Steps finer than the widest and wider than the narrowest resonances near x = 50.
    double sharpest = 0;
    for (int i = 0; i < 400; ++i) {
        double n = 0;
        for (const auto& [real_sum, sum, real_difference, difference] :
             made_of({1.5, 0, 50 + i * 0.00371}).terms) {
            ++n;
            // a_n and b_n, either way round.
            for (const double sign : {1.0, -1.0}) {
                const double c = 2 * (2 * n + 1) / (n * (n + 1));
                const std::complex<double> one((real_sum + sign * real_difference) / c,
                                               (sum + sign * difference) / c);
                EXPECT_NEAR(std::norm(one), one.real(), 1e-12);
                if (n > 56) sharpest = std::max(sharpest, one.real());
            }
        }
    }
    EXPECT_GT(sharpest, 0.5);
}

TEST(LorenzMie, BothPolarisationsAreOneAtThePoles) {
    for (const double x : {0.5, 5.213, 1000.0, 1e5}) {
        const test::MieSphere sphere = made_of({1.33, 1e-4, x});
        const MieIntensities at = sphere.intensities({0});
        EXPECT_EQ(at.perpendicular[0], at.parallel[0]);
        EXPECT_NEAR(at.back_perpendicular[0] / at.back_parallel[0], 1, 1e-12);
        EXPECT_NEAR(at.back_perpendicular[0] / std::norm(sphere.at_pole(2)), 1, 1e-9);
        // |S(0)| is at least its real part.
        const double real = sphere.at_pole(0).real();
        EXPECT_GE(at.perpendicular[0], real * real * (1 - 1e-12));
    }
}

// Sizes whose series begin and end at other places, in all lanes of a vector and in some.
TEST(LorenzMie, ManySpheresAtOnceAreThoseOneByOne) {
    for (const ComplexNumber index :
         {ComplexNumber{1.33, 2e-9}, ComplexNumber{1.5, 0.1}, ComplexNumber{0.75, 0}}) {
        for (const double factor : {1.001, 1.7, 30.0}) {
            std::vector<double> sizes;
            for (double x = 1e-3; x < 2e3 && sizes.size() < 19; x *= factor) sizes.push_back(x);
            for (double x = 1e3; sizes.size() < 37; x *= 1 + 1e-3 * factor) sizes.push_back(x);
            std::vector<test::MieSphere> wanted;
            for (const double size : sizes) wanted.push_back(test::mie_sphere(size, index));
            test::on_every_target([&](const char* target) {
                std::vector<MieTerms> terms(sizes.size());
                std::vector<MieEfficiencies> efficiencies(sizes.size());
                mie_series(sizes, index, terms, efficiencies);
                for (std::size_t i = 0; i < sizes.size(); ++i) {
                    const MieEfficiencies& q = wanted[i].efficiencies;
                    EXPECT_EQ(terms[i], wanted[i].terms) << target << sizes[i];
                    EXPECT_EQ(efficiencies[i].extinction, q.extinction) << target << sizes[i];
                    EXPECT_EQ(efficiencies[i].scattering, q.scattering) << target << sizes[i];
                    EXPECT_EQ(efficiencies[i].absorption, q.absorption) << target << sizes[i];
                    EXPECT_EQ(efficiencies[i].mean_cosine, q.mean_cosine) << target << sizes[i];
                }
            });
        }
    }
}

TEST(LorenzMie, SameBitsOnEveryTargetAndAnyNumberOfThreads) {
    std::vector<MieTerms> spheres;
    std::vector<double> weights;
    for (int i = 1; i < 20; ++i) {
        spheres.push_back(made_of({1.33, 1e-5, 3.7 * i}).terms);
        weights.push_back(1.0 / i);
    }
    std::vector<double> one_minus;
    for (int i = 0; i < 37; ++i) one_minus.push_back(i / 36.0);
    const auto summed = [&](int threads) {
        MieIntensities sums = no_intensities(one_minus.size());
        add_mie_intensities(spheres, weights, one_minus, threads, sums);
        return sums;
    };
    const MieIntensities wanted = summed(1);
    const auto expect_same = [&](const MieIntensities& made) {
        EXPECT_EQ(made.perpendicular, wanted.perpendicular);
        EXPECT_EQ(made.parallel, wanted.parallel);
        EXPECT_EQ(made.back_perpendicular, wanted.back_perpendicular);
        EXPECT_EQ(made.back_parallel, wanted.back_parallel);
    };
    expect_same(summed(3));
    test::on_every_target([&](const char*) { expect_same(summed(1)); });
}

// Series that end after few terms, none of them small: at odd and at even n, at both angles.
TEST(LorenzMie, NoTermIsLeftOut) {
    const std::array<std::array<double, 4>, 5> all = {
        {{1, 2, -1, 0.5}, {0.5, -1, 2, 1}, {2, 1, 1, -2}, {-1, 0.5, 0.25, 1}, {1, 1, -2, 3}}};
    const double mu = 0.3;
    for (std::size_t count = 1; count <= all.size(); ++count) {
        const MieTerms terms(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
        MieIntensities made = no_intensities(1);
        add_mie_intensities(std::array{terms}, std::array{1.0}, {1 - mu}, 1, made);
        for (const double cosine : {mu, -mu}) {
            std::complex<double> sum, difference;
            double pi = 1, before = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const double n = static_cast<double>(i + 1);
                const double tau = n * cosine * pi - (n + 1) * before;
                sum += std::complex<double>(terms[i][0], terms[i][1]) * (pi + tau);
                const double sign = i % 2 == 0 ? 1 : -1;  // MieTerms have it for even n
                difference += sign * std::complex<double>(terms[i][2], terms[i][3]) * (pi - tau);
                const double next = ((2 * n + 1) * cosine * pi - (n + 1) * before) / n;
                before = pi;
                pi = next;
            }
            const double perpendicular = std::norm(0.5 * (sum + difference));
            const double parallel = std::norm(0.5 * (sum - difference));
            const bool back = cosine < 0;
            EXPECT_NEAR((back ? made.back_perpendicular : made.perpendicular)[0], perpendicular,
                        1e-12 * perpendicular)
                << count << ' ' << cosine;
            EXPECT_NEAR((back ? made.back_parallel : made.parallel)[0], parallel, 1e-12 * parallel)
                << count << ' ' << cosine;
        }
    }
}

}  // namespace
}  // namespace skybake
