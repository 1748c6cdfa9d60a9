// Complex arithmetic that gives the same bits with every compiler: the products and quotients of
// std::complex are the run-time library's, and differ between libgcc's and compiler-rt's.
#pragma once

namespace skybake {

struct ComplexNumber {
    double real = 0;
    double imaginary = 0;
};

inline ComplexNumber operator+(ComplexNumber a, ComplexNumber b) {
    return {a.real + b.real, a.imaginary + b.imaginary};
}
inline ComplexNumber operator-(ComplexNumber a, ComplexNumber b) {
    return {a.real - b.real, a.imaginary - b.imaginary};
}
inline ComplexNumber operator*(double a, ComplexNumber b) { return {a * b.real, a * b.imaginary}; }
inline ComplexNumber operator*(ComplexNumber a, ComplexNumber b) {
    return {a.real * b.real - a.imaginary * b.imaginary,
            a.real * b.imaginary + a.imaginary * b.real};
}
inline ComplexNumber conjugate(ComplexNumber a) { return {a.real, -a.imaginary}; }
inline double squared_modulus(ComplexNumber a) {
    return a.real * a.real + a.imaginary * a.imaginary;
}
// 1 / a, where |a|^2 neither overflows nor underflows.
inline ComplexNumber inverse(ComplexNumber a) { return (1 / squared_modulus(a)) * conjugate(a); }

}  // namespace skybake
