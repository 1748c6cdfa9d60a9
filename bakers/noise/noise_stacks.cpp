#include "bakers/noise/noise_stacks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake::noise {
namespace {

AxisBasis axis_basis(const TileAxis& axis, int frequency, bool derivative, float amplitude) {
    AxisBasis basis;
    const auto count = static_cast<std::size_t>(axis.size + kLanePadding);
    for (AlignedFloats* values :
         {&basis.weight_0, &basis.weight_1, &basis.distance_0, &basis.distance_1}) {
        values->resize(count);
    }
    for (int i = 0; i < axis.size; ++i) {
        const LatticePosition position = lattice_position(axis, frequency, i);
        const GradientBasis value = scaled(
            derivative ? gradient_basis_derivative(position) : gradient_basis(position), amplitude);
        const auto at = static_cast<std::size_t>(i);
        basis.weight_0[at] = value.weight_0;
        basis.weight_1[at] = value.weight_1;
        basis.distance_0[at] = value.distance_0;
        basis.distance_1[at] = value.distance_1;
    }
    return basis;
}

OctaveShape shape_of(NoiseFractal fractal) {
    if (fractal == NoiseFractal::ridged) return OctaveShape::one_minus_absolute;
    return fractal == NoiseFractal::billow ? OctaveShape::absolute : OctaveShape::plain;
}

// The place of a frame among `cells` lattice points of a loop, with all its digits.
LatticePosition place_in_time(int period, int cells, int time) {
    return lattice_position({period, 0}, cells, time);
}

std::optional<TimeStep> time_step(const OctaveMaker& maker, const GradientOctave& octave) {
    if (maker.period == 0) return std::nullopt;
    const int cells = maker.cells_in_time(octave.frequency);
    const LatticePosition at = place_in_time(maker.period, cells, maker.time);
    const auto key_of = [&](std::int64_t cell) {
        return time_key(octave.key, wrapped_cell(cell, cells));
    };
    return TimeStep{{key_of(at.cell), key_of(at.cell + 1)}, gradient_basis(at)};
}

}  // namespace

AxisCells axis_cells(const TileAxis& axis, int frequency) {
    AxisCells cells;
    const auto count = static_cast<std::size_t>(axis.size);
    cells.cell.resize(count + kLanePadding);
    cells.fraction.resize(count + kLanePadding);
    for (int i = 0; i < axis.size; ++i) {
        const LatticePosition position = lattice_position(axis, frequency, i);
        cells.cell[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(position.cell);
        cells.fraction[static_cast<std::size_t>(i)] = cell_fraction(position);
    }
    std::fill(cells.cell.begin() + axis.size, cells.cell.end(),
              cells.cell[static_cast<std::size_t>(axis.size - 1)]);
    return cells;
}

double lowest_cells(const Noise& noise) {
    double lowest = std::numeric_limits<double>::max();
    for (const NoiseChannel& channel : noise.channels) {
        for (const NoiseOctaves* octaves :
             {&channel.octaves, &channel.worley_octaves, &channel.warp_octaves}) {
            for (const auto& [x, y, z] : octaves->frequencies) {
                lowest = std::min(lowest, double{1} * x * y * z);
            }
        }
    }
    return lowest;
}

std::vector<double> weights_of(const NoiseOctaves& octaves) {
    const double sum = std::accumulate(octaves.gains.begin(), octaves.gains.end(), 0.0);
    return mapped<double>(octaves.gains, [&](const double gain) { return gain / sum; });
}

std::uint64_t Keys::operator()(Purpose purpose, const NoiseOctaves& octaves, std::size_t i) const {
    const auto begin = octaves.frequencies.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(i);
    const auto repetition = std::count(begin, end, octaves.frequencies[i]);
    return octave_key(noise_seed, channel_seed, purpose, octaves.frequencies[i],
                      static_cast<int>(repetition));
}

GradientOctave OctaveMaker::octave(const NoiseOctaves& octaves, std::size_t i, Purpose purpose,
                                   double amplitude, int derivative_axis) const {
    GradientOctave octave;
    octave.frequency = octaves.frequencies[i];
    octave.key = keys(purpose, octaves, i);
    octave.derivative_axis = derivative_axis;
    octave.amplitude = static_cast<float>(amplitude);
    octave.time = time_step(*this, octave);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        octave.cells[axis] = axis_cells(axes[axis], octave.frequency[axis]);
        octave.basis[axis] =
            axis_basis(axes[axis], octave.frequency[axis],
                       derivative_axis == static_cast<int>(axis), axis == 1 ? octave.amplitude : 1);
    }
    return octave;
}

int OctaveMaker::cells_in_time(const std::array<int, 3>& frequency) const {
    const double ratio = double{1} * frequency[0] * frequency[1] * frequency[2] / lowest_cells;
    const double faster = exponential(2.0 / 9 * logarithm(ratio));
    return static_cast<int>(std::lround(time_cells * faster));
}

// A slow point goes its whole path, to and fro, once per two cells of the lattice along time, so that it
// crosses a cell while gradients change from one lattice to the next. Odd numbers are rounded down.
PathShift OctaveMaker::shift(const std::array<int, 3>& frequency) const {
    if (period == 0) return {};
    const int paths = std::max(1, cells_in_time(frequency) / 2);
    const auto along = [&](int count) {
        const LatticePosition at = place_in_time(period, count, time);
        return static_cast<std::uint32_t>(static_cast<std::uint64_t>(at.numerator) * kPathSteps /
                                          static_cast<std::uint64_t>(at.denominator));
    };
    return {along(paths), along(paths + 1)};
}

GradientStack gradient_stack(const NoiseChannel& channel, const OctaveMaker& maker) {
    GradientStack stack;
    stack.shape = shape_of(channel.fractal);
    const std::vector<double> weights = weights_of(channel.octaves);
    const bool plain = stack.shape == OctaveShape::plain;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        stack.octaves.push_back(
            maker.octave(channel.octaves, i, Purpose::gradient, plain ? weights[i] : 1));
        stack.weights.push_back(static_cast<float>(weights[i]));
    }
    return stack;
}

GradientStack curl_stack(const NoiseOctaves& octaves, std::size_t component,
                         const std::array<Purpose, 3>& potentials, double factor,
                         const OctaveMaker& maker) {
    const std::size_t next = (component + 1) % 3;
    const std::size_t last = (component + 2) % 3;
    const auto& first_octave = octaves.frequencies.front();
    const double unit = *std::ranges::max_element(first_octave);
    GradientStack stack;
    const std::vector<double> weights = weights_of(octaves);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto& frequency = octaves.frequencies[i];
        const double weight = weights[i] * factor;
        stack.octaves.push_back(maker.octave(
            octaves, i, potentials[last], weight * frequency[next] / unit, static_cast<int>(next)));
        stack.octaves.push_back(maker.octave(octaves, i, potentials[next],
                                             -weight * frequency[last] / unit,
                                             static_cast<int>(last)));
    }
    return stack;
}

WarpPlan warp_plan(const NoiseChannel& channel, const std::array<int, 3>& repeats,
                   const OctaveMaker& maker) {
    WarpPlan warp;
    const std::vector<double> weights = weights_of(channel.warp_octaves);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double strength = channel.warp_strength / repeats[axis];
        if (channel.warp_by == config::NoiseWarp::curl) {
            warp[axis] = curl_stack(channel.warp_octaves, axis, kWarps, strength, maker);
            continue;
        }
        for (std::size_t i = 0; i < weights.size(); ++i) {
            warp[axis].octaves.push_back(
                maker.octave(channel.warp_octaves, i, kWarps[axis], weights[i] * strength));
        }
    }
    return warp;
}

}  // namespace skybake::noise
