// One sphere by itself, of the kernel for many.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"

namespace skybake::test {

struct MieSphere {
    double size_parameter = 0;
    MieTerms terms;
    MieEfficiencies efficiencies;

    // S at 0 (part 0) or 180 degrees (part 2): pi_n and tau_n are n (n + 1) / 2 there.
    std::complex<double> at_pole(std::size_t part) const {
        std::complex<double> sum;
        double n = 1;
        for (const auto& term : terms) {
            sum += n * (n + 1) / 2 * std::complex(term[part], term[part + 1]);
            ++n;
        }
        return sum;
    }
    double backscatter() const {
        return 4 / (size_parameter * size_parameter) * std::norm(at_pole(2));
    }
    MieIntensities intensities(const std::vector<double>& one_minus) const {
        MieIntensities sums = no_intensities(one_minus.size());
        add_mie_intensities(std::array{terms}, std::array{1.0}, one_minus, 1, sums);
        return sums;
    }
};

inline MieSphere mie_sphere(double size_parameter, ComplexNumber refractive_index) {
    MieSphere sphere{size_parameter, {}, {}};
    mie_series({&size_parameter, 1}, refractive_index, {&sphere.terms, 1},
               {&sphere.efficiencies, 1});
    return sphere;
}

}  // namespace skybake::test
