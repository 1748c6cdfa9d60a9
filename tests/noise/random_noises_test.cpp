// Properties of any noise: kernels equal the specification bit for bit on every instruction set,
// and the specification is as near to the reference as running error analysis says.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "bakers/noise/noise_reference.h"
#include "tests/noise/every_target.h"
#include "tests/noise/running_error.h"
#include "tests/support/any_values.h"

namespace skybake::noise {
namespace {

template <class Choice>
Choice any_of_first(int count) {
    return static_cast<Choice>(*rc::gen::inRange(0, count));
}

int any_size() {
    namespace gen = rc::gen;
    return *gen::weightedOneOf<int>(
        {{1, gen::just(1)},
         {1, gen::map(gen::inRange(1, 6), [](int n) { return 16 * n; })},
         {1, gen::element(2, 3, 5, 7, 31, 131, 257, 16384)},
         {3, gen::inRange(1, 40)}});
}

int any_frequency(int size) {
    namespace gen = rc::gen;
    return *gen::weightedOneOf<int>(
        {{4, gen::element(1, size, std::max(1, size / 2), std::max(1, size / 4))},
         {1, gen::element(255, 256, 257, 300, 1000, 1048576)},
         {3, gen::inRange(1, std::max(2, size))}});
}

NoiseOctaves any_octaves(const std::array<int, 3>& size) {
    NoiseOctaves octaves;
    const int count = *rc::gen::inRange(1, 4);
    const bool equal = *rc::gen::arbitrary<bool>();
    for (int i = 0; i < count; ++i) {
        std::array<int, 3> frequency = {any_frequency(size[0]), any_frequency(size[1]),
                                        any_frequency(size[2])};
        if (equal) frequency.fill(frequency[0]);
        octaves.frequencies.push_back(frequency);
        octaves.gains.push_back(i == 0 ? 1 : test::any_number(0, 4));
    }
    return octaves;
}

NoiseChannel any_channel(const std::array<int, 3>& size) {
    NoiseChannel channel;
    channel.type = any_of_first<NoiseType>(6);
    channel.value = test::any_number(-2, 2);
    channel.octaves = any_octaves(size);
    channel.worley_octaves = any_octaves(size);
    channel.fractal = any_of_first<config::NoiseFractal>(4);
    channel.feature = any_of_first<config::WorleyFeature>(3);
    channel.value_form = any_of_first<config::WorleyValue>(4);
    channel.component = any_of_first<config::CurlComponent>(3);
    channel.seed = *rc::gen::element<std::uint64_t>(0, 1, ~std::uint64_t{0});
    if (*rc::gen::inRange(0, 3) == 0) {
        channel.remap = {test::any_number(-1, 0.5), test::any_number(0.6, 2),
                         test::any_number(-2, 2), test::any_number(-2, 2)};
    }
    channel.invert = *rc::gen::arbitrary<bool>();
    if (*rc::gen::inRange(0, 3) == 0) channel.bias = test::any_number(0.001, 0.999);
    if (*rc::gen::inRange(0, 3) == 0) {
        const double from = test::any_number(-1, 1);
        channel.smoothstep = {from, from + test::any_number(0.01, 2)};
    }
    if (*rc::gen::inRange(0, 3) == 0) {
        const double low = *rc::gen::element(0.0, test::any_number(-1, 0.5));
        channel.clamp = {low, *rc::gen::element(low, 1.0, test::any_number(0.5, 2))};
    }
    return channel;
}

struct Case {
    Noise noise;
    std::array<int, 3> size;
    VoxelBox box;
};

// Boxes of about 600 voxels or fewer, of either path.
Case any_case() {
    Case any;
    any.size = {any_size(), any_size(), any_size()};
    any.noise.seed = *rc::gen::arbitrary<std::uint64_t>();
    any.noise.sampling = any_of_first<config::NoiseSampling>(3);
    any.noise.pack = any_of_first<config::NoisePacking>(3);
    any.noise.period = *rc::gen::element(0, 0, 1, 7, 48);
    any.noise.time = *rc::gen::inRange(-100, 100);
    any.noise.time_cells = *rc::gen::inRange(1, 5);
    for (int& tiles : any.noise.drift) tiles = *rc::gen::inRange(-3, 4);
    const int channels = any.noise.pack == config::NoisePacking::shape    ? 4
                         : any.noise.pack == config::NoisePacking::detail ? 3
                                                                          : *rc::gen::inRange(1, 4);
    for (int i = 0; i < channels; ++i) any.noise.channels.push_back(any_channel(any.size));
    std::int64_t left = 640;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
        const auto most = static_cast<int>(std::min<std::int64_t>(any.size[axis], left));
        const int least = std::max(1, most / 8);
        any.box.size[axis] = *rc::gen::inRange(least, most + 1);
        any.box.origin[axis] = *rc::gen::inRange(0, any.size[axis] - any.box.size[axis] + 1);
        left /= any.box.size[axis];
    }
    return any;
}

// Displaces every second channel that may be displaced, by up to many tiles.
void displace(const std::array<int, 3>& size, NoiseChannel& channel) {
    const bool may = channel.type != NoiseType::constant && channel.type != NoiseType::curl;
    if (!may || *rc::gen::arbitrary<bool>()) return;
    channel.warp_strength = *rc::gen::element(1e-6, -0.1, 0.3, 16.0);
    channel.warp_by = any_of_first<config::NoiseWarp>(2);
    channel.warp_octaves = any_octaves(size);
}

TEST(RandomNoises, KernelsEqualTheSpecification) {
    EXPECT_TRUE(rc::check([] {
        for (int i = 0; i < 4; ++i) {
            Case any = any_case();
            for (NoiseChannel& channel : any.noise.channels) displace(any.size, channel);
            const test::Mismatches mismatches =
                test::unlike_specification(make_noise_plan(any.noise, any.size), any.box);
            RC_LOG(mismatches.first);
            RC_ASSERT(mismatches.count == 0);
        }
    }));
}

TEST(RandomNoises, AreWithinTheirRunningErrorOfTheReference) {
    double nearest = 0;  // to the bound
    std::int64_t unbounded = 0;
    std::int64_t bounded = 0;
    EXPECT_TRUE(rc::check([&] {
        const Case any = any_case();
        const NoisePlan plan = make_noise_plan(any.noise, any.size);
        for (int i = 0; i < 16; ++i) {
            Voxel voxel;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                voxel[axis] = any.box.origin[axis] + (i * 7 + 3) % any.box.size[axis];
            }
            const auto place = test::place_of(plan.axes, voxel);
            const std::vector<float> found = noise_at(plan, voxel);
            const std::vector<test::Uncertain> wanted = test::uncertain_noise(any.noise, place);
            const std::vector<double> reference = noise_reference(any.noise, place);
            RC_ASSERT(found.size() == wanted.size());
            RC_ASSERT(found.size() == reference.size());
            for (std::size_t c = 0; c < found.size(); ++c) {
                // Schlick's bias has a pole beyond [0, 1]: nothing bounds values at it.
                if (!std::isfinite(wanted[c].error)) {
                    ++unbounded;
                    continue;
                }
                ++bounded;
                const double error = std::fabs(found[c] - reference[c]);
                RC_ASSERT(std::isfinite(found[c]));
                RC_ASSERT(error <= wanted[c].error + 1e-12);
                nearest = std::max(nearest, error / (wanted[c].error + 1e-12));
            }
        }
    }));
    EXPECT_GT(bounded, 100 * unbounded);
    EXPECT_GT(nearest, 0.05);  // the bound is not idle
}

}  // namespace
}  // namespace skybake::noise
