// The series of as many spheres as there are lanes: mie_series of lorenz_mie.h. Its scalar
// specification is lorenz_mie.cpp.
//
// Highway includes this file once per target (see its foreach_target.h), so it has no ordinary
// include guard.
#if defined(SKYBAKE_BAKERS_AIR_MIE_SERIES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_AIR_MIE_SERIES_INL_H_
#undef SKYBAKE_BAKERS_AIR_MIE_SERIES_INL_H_
#else
#define SKYBAKE_BAKERS_AIR_MIE_SERIES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/math/lanes-inl.h"
#include "bakers/math/transcendental.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The operations of ComplexNumber, in their order.
struct ComplexLanes {
    Lanes real, imaginary;
};
HWY_INLINE ComplexLanes product(ComplexNumber a, ComplexLanes b) {
    return {Lanes(a.real) * b.real - Lanes(a.imaginary) * b.imaginary,
            Lanes(a.real) * b.imaginary + Lanes(a.imaginary) * b.real};
}
// The real part of a conjugate(b).
HWY_INLINE Lanes real_product(ComplexLanes a, ComplexLanes b) {
    return a.real * b.real + a.imaginary * b.imaginary;
}
HWY_INLINE Lanes squared(ComplexLanes a) { return real_product(a, a); }

using PerLane = std::array<double, Lanes::kCount>;

// One sphere for each lane, which starts and ends where its own sphere does.
struct LaneSpheres {
    PerLane x{}, sine{}, cosine{};
    PerLane count{}, upward{};                     // of terms; of steps of psi upwards
    PerLane start_of_ratios{}, start_of_slopes{};  // of the recurrences downwards
    PerLane z_real{}, z_imaginary{};               // 1 / (m x)
    std::size_t most = 0;                          // terms
};

double largest_of(const PerLane& values) { return *std::max_element(values.begin(), values.end()); }
double least_of(const PerLane& values) { return *std::min_element(values.begin(), values.end()); }

LaneSpheres lane_spheres(std::span<const double> size_parameters, ComplexNumber index) {
    LaneSpheres s;
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
        const double x = size_parameters[std::min(i, size_parameters.size() - 1)];
        const MieSteps steps = mie_steps(x, index);
        const SineCosine at_x = sine_and_cosine(x);
        const ComplexNumber per_z = inverse(x * index);
        s.x[i] = x;
        s.sine[i] = at_x.sine;
        s.cosine[i] = at_x.cosine;
        s.count[i] = steps.count;
        s.upward[i] = steps.upward;
        s.start_of_ratios[i] = steps.start_of_ratios;
        s.start_of_slopes[i] = steps.start_of_slopes;
        s.z_real[i] = per_z.real;
        s.z_imaginary[i] = per_z.imaginary;
        s.most = std::max(s.most, static_cast<std::size_t>(steps.count));
    }
    return s;
}

// One vector for each n.
class LaneArray {
  public:
    explicit LaneArray(std::size_t size) : values_(size * Lanes::kCount) {}

    HWY_INLINE Lanes at(std::size_t n) const {
        return Lanes::load(values_.data() + n * Lanes::kCount);
    }
    HWY_INLINE void put(std::size_t n, Lanes value) {
        value.store(values_.data() + n * Lanes::kCount);
    }

  private:
    std::vector<double> values_;
};

// The real part of D_n at 2 n - 2, the imaginary one at 2 n - 1.
void slopes(const LaneSpheres& s, LaneArray& out) {
    const Lanes start = Lanes::load(s.start_of_slopes.data());
    const ComplexLanes per_z = {Lanes::load(s.z_real.data()), Lanes::load(s.z_imaginary.data())};
    ComplexLanes d = {(start + Lanes(1.0)) * per_z.real, (start + Lanes(1.0)) * per_z.imaginary};
    for (std::size_t n = static_cast<std::size_t>(largest_of(s.start_of_slopes)); n > 1; --n) {
        const Lanes at(static_cast<double>(n));
        const ComplexLanes n_per_z = {at * per_z.real, at * per_z.imaginary};
        const ComplexLanes sum = {d.real + n_per_z.real, d.imaginary + n_per_z.imaginary};
        const Lanes per_square = Lanes(1.0) / squared(sum);
        const LaneMask runs = at <= start;
        d.real = select(runs, n_per_z.real - per_square * sum.real, d.real);
        d.imaginary = select(runs, n_per_z.imaginary + per_square * sum.imaginary, d.imaginary);
        if (n - 1 > s.most) continue;
        out.put(2 * n - 4, d.real);
        out.put(2 * n - 3, d.imaginary);
    }
}

// psi_n at n.
void riccati_bessel_lanes(const LaneSpheres& s, LaneArray& psi, LaneArray& ratios) {
    const Lanes x = Lanes::load(s.x.data());
    const Lanes upward = Lanes::load(s.upward.data());
    const auto first = static_cast<std::size_t>(least_of(s.upward));
    const auto last = static_cast<std::size_t>(largest_of(s.upward));
    Lanes value = Lanes::load(s.sine.data());
    Lanes before = Lanes::load(s.cosine.data());
    psi.put(0, value);
    for (std::size_t n = 0; n < last; ++n) {
        const Lanes next = Lanes(2 * static_cast<double>(n) + 1) / x * value - before;
        before = value;
        value = next;
        psi.put(n + 1, value);
    }
    const Lanes start = Lanes::load(s.start_of_ratios.data());
    Lanes ratio = (Lanes(2.0) * start + Lanes(1.0)) / x;
    for (auto n = static_cast<std::size_t>(largest_of(s.start_of_ratios)); n > first; --n) {
        const Lanes at(static_cast<double>(n));
        const Lanes next = Lanes(2 * static_cast<double>(n) + 1) / x - Lanes(1.0) / ratio;
        ratio = select(at < start, next, ratio);
        if (n <= s.most) ratios.put(n, ratio);
    }
    value = psi.at(first);
    for (std::size_t n = first + 1; n <= s.most; ++n) {
        value = value / ratios.at(n);
        if (n <= last) value = select(Lanes(static_cast<double>(n)) <= upward, psi.at(n), value);
        psi.put(n, value);
    }
}

struct RadialLanes {
    Lanes psi, psi_before, chi, chi_before;
};
struct AmplitudeLanes {
    ComplexLanes value;
    Lanes absorbed;
};

HWY_INLINE AmplitudeLanes amplitude_lanes(ComplexLanes slope, Lanes n_per_x,
                                          const RadialLanes& at) {
    const Lanes real = slope.real + n_per_x;
    const ComplexLanes p = {real * at.psi - at.psi_before, slope.imaginary * at.psi};
    const ComplexLanes q = {real * at.chi - at.chi_before, slope.imaginary * at.chi};
    const ComplexLanes below = {p.real + q.imaginary, p.imaginary - q.real};
    const Lanes per_square = Lanes(1.0) / squared(below);
    return {{per_square * (p.real * below.real + p.imaginary * below.imaginary),
             per_square * (p.imaginary * below.real - p.real * below.imaginary)},
            -slope.imaginary * per_square};
}

struct LaneSums {
    Lanes scattered, along, absorbed;
};

// Adds term n, which follows the term of a and b before.
void add_to_sums(double n, LaneMask runs, const AmplitudeLanes& a, const AmplitudeLanes& b,
                 ComplexLanes a_before, ComplexLanes b_before, LaneSums& sums) {
    const double m = n - 1;
    if (n > 1) {
        const Lanes cross = Lanes(m * (m + 2) / (m + 1)) *
                            (real_product(a_before, a.value) + real_product(b_before, b.value));
        sums.along = sums.along + zero_unless(runs, cross);
    }
    const Lanes own = Lanes((2 * n + 1) / (n * (n + 1))) * real_product(a.value, b.value);
    sums.along = sums.along + zero_unless(runs, own);
    const Lanes scattered = Lanes(2 * n + 1) * (squared(a.value) + squared(b.value));
    sums.scattered = sums.scattered + zero_unless(runs, scattered);
    sums.absorbed = sums.absorbed + zero_unless(runs, Lanes(2 * n + 1) * (a.absorbed + b.absorbed));
}

// Term number i of each sphere that has it.
void put_terms(std::size_t i, ComplexLanes a, ComplexLanes b, const LaneSpheres& s,
               std::span<MieTerms> terms) {
    const double n = static_cast<double>(i + 1);
    const double factor = (2 * n + 1) / (n * (n + 1));
    const Lanes c(factor);
    const Lanes signed_c(i % 2 == 1 ? -factor : factor);
    std::array<PerLane, 4> values;
    (c * (a.real + b.real)).store(values[0].data());
    (c * (a.imaginary + b.imaginary)).store(values[1].data());
    (signed_c * (a.real - b.real)).store(values[2].data());
    (signed_c * (a.imaginary - b.imaginary)).store(values[3].data());
    for (std::size_t k = 0; k < terms.size(); ++k) {
        if (n <= s.count[k]) {
            terms[k][i] = {values[0][k], values[1][k], values[2][k], values[3][k]};
        }
    }
}

// Up to as many spheres as there are lanes.
void lane_series(std::span<const double> size_parameters, ComplexNumber index,
                 std::span<MieTerms> terms, std::span<MieEfficiencies> efficiencies) {
    const LaneSpheres s = lane_spheres(size_parameters, index);
    LaneArray d(2 * s.most);
    LaneArray psi(s.most + 1);
    LaneArray ratios(s.most + 1);
    slopes(s, d);
    riccati_bessel_lanes(s, psi, ratios);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        terms[k].resize(static_cast<std::size_t>(s.count[k]));
    }
    const ComplexNumber per_index = inverse(index);
    const Lanes x = Lanes::load(s.x.data());
    const Lanes count = Lanes::load(s.count.data());
    Lanes chi = Lanes::load(s.cosine.data());
    Lanes chi_before = -Lanes::load(s.sine.data());
    const Lanes zero(0.0);
    LaneSums sums = {zero, zero, zero};
    AmplitudeLanes a = {{zero, zero}, zero};
    AmplitudeLanes b = a;
    for (std::size_t i = 0; i < s.most; ++i) {
        const double n = static_cast<double>(i + 1);
        const Lanes next = Lanes(2 * n - 1) / x * chi - chi_before;
        chi_before = chi;
        chi = next;
        const RadialLanes at = {psi.at(i + 1), psi.at(i), chi, chi_before};
        const Lanes n_per_x = Lanes(n) / x;
        const ComplexLanes a_before = a.value;
        const ComplexLanes b_before = b.value;
        const ComplexLanes slope = {d.at(2 * i), d.at(2 * i + 1)};
        a = amplitude_lanes(product(per_index, slope), n_per_x, at);
        b = amplitude_lanes(product(index, slope), n_per_x, at);
        add_to_sums(n, Lanes(n) <= count, a, b, a_before, b_before, sums);
        put_terms(i, a.value, b.value, s, terms);
    }
    PerLane scattered{}, along{}, absorbed{};
    sums.scattered.store(scattered.data());
    sums.along.store(along.data());
    sums.absorbed.store(absorbed.data());
    for (std::size_t k = 0; k < efficiencies.size(); ++k) {
        MieEfficiencies& q = efficiencies[k];
        const double per_area = 2 / s.x[k] / s.x[k];
        q.scattering = per_area * scattered[k];
        q.absorption = index.imaginary > 0 ? per_area * absorbed[k] : 0.0;
        q.extinction = q.scattering + q.absorption;
        q.mean_cosine = 2 * along[k] / scattered[k];
    }
}

void all_series(std::span<const double> size_parameters, ComplexNumber index,
                std::span<MieTerms> terms, std::span<MieEfficiencies> efficiencies) {
    for (std::size_t i = 0; i < size_parameters.size(); i += Lanes::kCount) {
        const std::size_t count = std::min(Lanes::kCount, size_parameters.size() - i);
        lane_series(size_parameters.subspan(i, count), index, terms.subspan(i, count),
                    efficiencies.subspan(i, count));
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_AIR_MIE_SERIES_INL_H_
