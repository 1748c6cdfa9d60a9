// Where scattering by spheres and tables of phase functions go wrong, held against extended
// precision, limits and identities.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/particle_scattering.h"
#include "tests/phase/lorenz_mie_reference.h"
#include "tests/phase/one_sphere.h"
#include "tests/support/hard_case.h"

namespace skybake {
namespace {

using test::hold;

struct Sphere {
    const char* name;
    double size_parameter;
    ComplexNumber index;
};

// Extended precision where it takes no more than seconds.
const std::array kSpheres = {
    Sphere{"8 sphere of x 1e-3, water", 1e-3, {1.33, 1e-8}},
    Sphere{"8 sphere of x 5.213, m 1.55", 5.213, {1.55, 0}},
    Sphere{"8 sphere of x 114, water: a cloud droplet", 114, {1.333, 2e-9}},
    Sphere{"8 sphere of x 3000, water: drizzle", 3000, {1.333, 2e-9}},
    Sphere{"8 sphere of x 100, m 10 + 10 i: absorbs all", 100, {10, 10}},
    Sphere{"8 sphere of x 50, m 1.00001: hardly there", 50, {1.00001, 0}},
    Sphere{"8 sphere of x 30, m 0.75: a bubble", 30, {0.75, 0}},
};

TEST(PhaseHardCase, Case08SpheresInExtendedPrecision) {
    const std::vector<double> one_minus = {0, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 1};
    for (const Sphere& sphere : kSpheres) {
        const test::MieSphere made = test::mie_sphere(sphere.size_parameter, sphere.index);
        const MieEfficiencies& found = made.efficiencies;
        std::vector<double> cosines;
        for (const double value : one_minus) cosines.push_back(1 - value);
        const test::ReferenceSphere wanted = test::reference_sphere(
            sphere.size_parameter, {sphere.index.real, sphere.index.imaginary}, cosines);
        hold(sphere.name, "Q in extended precision, relative",
             std::max(std::fabs(found.extinction / wanted.extinction - 1),
                      std::fabs(found.scattering / wanted.scattering - 1)),
             1e-8);
        const MieIntensities sums = made.intensities(one_minus);
        double worst = 0;
        for (std::size_t i = 0; i < one_minus.size(); ++i) {
            const double value = sums.perpendicular[i] + sums.parallel[i];
            const double reference = wanted.perpendicular[i] + wanted.parallel[i];
            worst = std::max(worst, std::fabs(value / reference - 1));
        }
        hold(sphere.name, "intensity in extended precision, relative", worst, 1e-6);
    }
}

TEST(PhaseHardCase, Case08LimitsOfSpheres) {
    // Q_ext - 2 falls as x^(-2/3).
    for (const double x : {1e4, 1e5}) {
        const double q = test::mie_sphere(x, {1.333, 1e-3}).efficiencies.extinction;
        hold("8 sphere of x " + std::to_string(static_cast<int>(x)), "Q = 2, relative",
             std::fabs(q / 2 - 1), 1e-2);
    }
    const double tiny = 1e-4;
    const std::complex<double> m(1.5, 0);
    const std::complex<double> polarisability = (m * m - 1.0) / (m * m + 2.0);
    const double rayleigh = 8.0 / 3 * std::pow(tiny, 4) * std::norm(polarisability);
    hold("8 sphere of x 1e-4", "Rayleigh's Q, relative",
         std::fabs(test::mie_sphere(tiny, {1.5, 0}).efficiencies.scattering / rayleigh - 1), 1e-7);
}

TEST(PhaseHardCase, Case08DistributionsOfSpheres) {
    config::Particles drops;
    drops.effective_radius = {10e-6};
    drops.effective_variance = 0.1;
    const ParticleScattering cloud = particle_scattering(drops, {550e-9}, 3e-3, 0);
    hold("8 cloud droplets of 10 um", "asks for 0.3 %, says how near it came", cloud.error, 3e-3);
    hold("8 cloud droplets of 10 um", "mean cosine of series and table, difference",
         std::fabs(tabulated_moments(cloud.phase, 1).back() - cloud.mean_cosine), 1e-3);
    hold("8 cloud droplets of 10 um", "integral over directions - 1",
         std::fabs(tabulated_moments(cloud.phase, 0)[0] - 1), 1e-12);
    const double most = *std::max_element(cloud.phase.forward.begin(), cloud.phase.forward.end());
    hold("8 cloud droplets of 10 um", "brightest straight on (1 - p(0) / largest)",
         1 - cloud.phase.forward.front() / most, 0);
}

}  // namespace
}  // namespace skybake
