#include "bakers/phase/check_particle_sizes.h"

#include <fmt/format.h>

#include <algorithm>

#include "bakers/phase/particle_scattering.h"

namespace skybake {

std::vector<config::Diagnostic> check_particle_sizes(const config::Parameters& parameters) {
    std::vector<config::Diagnostic> problems;
    for (const config::Particles& particles : parameters.particles) {
        double largest = 0;
        for (const config::Length wavelength : parameters.wavelengths) {
            largest = std::max(largest, largest_size_parameter(particles, wavelength));
        }
        if (largest <= kLargestSizeParameter) continue;
        config::Diagnostic problem;
        problem.severity = config::Severity::error;
        problem.code = "E0144";
        problem.message = fmt::format(
            "[particles.{}]: the largest spheres have a circumference of {:.3g} "
            "wavelengths, above {:g}",
            particles.name, largest, kLargestSizeParameter);
        problem.label = "give smaller ones, or longer wavelengths";
        problems.push_back(std::move(problem));
    }
    return problems;
}

}  // namespace skybake
