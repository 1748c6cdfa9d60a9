// Elementary functions that have the same bits on every machine, which those of the C library do
// not: they consist of sums, products and quotients, which IEEE 754 rounds correctly. Their relative
// error is below 1e-15. Arguments and results must be far from overflow, as optics' are.
#pragma once

namespace skybake::config {

// x must be above 0.
double logarithm(double x);

double exponential(double x);

// Returns e^x - 1, also where x is near 0; x may be as far below 0 as it likes.
double exponential_less_one(double x);

// Returns base^exponent; the base must be above 0.
double power(double base, double exponent);

}  // namespace skybake::config
