// The project's transcendental functions for plain doubles. transcendental-inl.h states their
// guarantees and why the C library's functions are not used.
#pragma once

#include "bakers/math/vectors.h"

namespace skybake {

double exponential(double x);             // e^x
Spectrum exponential(const Spectrum& x);  // of each component, with the same bits
double logarithm(double x);               // ln x, x > 0 and normal
double arc_cosine(double x);              // x in [-1, 1]
double cosine_of_pi(double x);            // cos(pi x), x in [0, 1]
double cosine_of_turns(double n);         // cos(2 pi n), any finite n

// sin x and cos x for |x| <= 1e6, each with an absolute error below 3e-16.
struct SineCosine {
    double sine = 0;
    double cosine = 1;
};
SineCosine sine_and_cosine(double x);

// The mean of e^-t for t in [0, x], x >= 0; `passing` is e^-x.
inline double mean_of_exponential(double x, double passing) {
    constexpr double kSmall = 1e-4;  // of which the series leaves x^2 / 6
    return x < kSmall ? 1 - 0.5 * x : (1 - passing) / x;
}

// Replaces each of `count` values by its exponential, a vector at a time, with the same bits as
// exponential(double).
void exponentials(double* values, int count);

}  // namespace skybake
