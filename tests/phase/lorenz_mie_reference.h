// Lorenz-Mie scattering as van de Hulst (1957, 9.22) and Kerker write it, in extended precision,
// every function by its plainest recurrence: slow, and what lorenz_mie.h is held against.
#pragma once

#include <complex>
#include <vector>

namespace skybake::test {

struct ReferenceSphere {
    double extinction = 0;  // 2/x^2 sum (2 n + 1) Re(a_n + b_n)
    double scattering = 0;
    double backscatter = 0;
    double mean_cosine = 0;
    std::vector<double> perpendicular, parallel;  // |S_1|^2 and |S_2|^2 at the cosines
};

// For x |m| up to some 10^4.
ReferenceSphere reference_sphere(double size_parameter, std::complex<double> refractive_index,
                                 const std::vector<double>& cosines);

}  // namespace skybake::test
