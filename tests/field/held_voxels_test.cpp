#include "bakers/field/held_voxels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cstdint>

#include "bakers/field/pixel_type.h"
#include "bakers/field/sparse_rows.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::sample_voxel;

constexpr std::array<int, 3> kSize = {700, 300, 5};  // slices of two boxes, the second smaller
constexpr int kChannels = 2;
constexpr std::int64_t kBytes = 1 << 24;  // enough for all of it

BakeOptions options_with(std::int64_t held_voxel_bytes) {
    return {.threads = 2, .held_voxel_bytes = held_voxel_bytes};
}

// Counts how often the voxels of a function are made. The lowest slices may be known to be empty.
class CountedVoxels : public VoxelSource {
  public:
    explicit CountedVoxels(FunctionVoxels::Function function, int empty_slices = 0)
        : voxels_(std::move(function)), empty_slices_(empty_slices) {}
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        made += box.count();
        voxels_.fill(box, channels);
    }
    bool is_empty(const VoxelBox& box) const override {
        ++asked;
        return box.origin[2] + box.size[2] <= empty_slices_;
    }
    mutable std::atomic<std::int64_t> made = 0;
    mutable std::atomic<int> asked = 0;  // whether a box is empty

  private:
    FunctionVoxels voxels_;
    int empty_slices_;
};

std::shared_ptr<CountedVoxels> half_empty() {
    return std::make_shared<CountedVoxels>(sample_voxel, kSize[2] / 2);
}

// Mostly zeros, in pieces of any length, with some voxels that are -0.
float sparse_voxel(int x, int y, int z, int channel) {
    const float value = sample_voxel(x / 5, y / 7, z, channel);
    if (value > 0.3F) return 0;
    return value < 0.01F ? -0.0F : sample_voxel(x, y, z, channel);
}

std::vector<std::uint32_t> bits_of(const VoxelSource& source, const VoxelBox& box) {
    std::vector<float> values(static_cast<std::size_t>(box.count()) * kChannels, 7);
    source.fill(box, {values.data(), values.data() + box.count()});
    std::vector<std::uint32_t> bits;
    for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
    return bits;
}

const VoxelBox kWhole{{}, kSize};
const VoxelBox kBoxes[] = {kWhole,
                           {{699, 299, 4}, {1, 1, 1}},
                           {{3, 2, 1}, {600, 290, 3}},
                           {{0, 180, 2}, {700, 60, 2}},
                           {{512, 0, 0}, {188, 300, 5}},
                           {{0, 170, 1}, {700, 90, 4}}};

TEST(HeldVoxels, AreTheVoxelsOfTheirSourceBitForBitWhateverFits) {
    for (const std::int64_t bytes : {std::int64_t{150000}, std::int64_t{1200000}, kBytes}) {
        const auto source = std::make_shared<CountedVoxels>(sparse_voxel);
        const auto held = held_voxels(source, kSize, kChannels, options_with(bytes));
        for (int pass = 0; pass < 2; ++pass) {
            for (const VoxelBox& box : kBoxes) {
                EXPECT_EQ(bits_of(*held, box), bits_of(FunctionVoxels(sparse_voxel), box)) << bytes;
            }
        }
        EXPECT_LE(VoxelMemory::total(), bytes);
    }
    EXPECT_EQ(VoxelMemory::total(), 0);
}

TEST(HeldVoxels, OfHalvesAreRoundedInHalfOfTheMemory) {
    const auto held = held_voxels(std::make_shared<CountedVoxels>(sparse_voxel), kSize, kChannels,
                                  options_with(kBytes));
    const auto halves = held_voxels(std::make_shared<CountedVoxels>(sparse_voxel), kSize, kChannels,
                                    options_with(kBytes), config::PixelType::half);
    const std::int64_t fixed = VoxelMemory::total() / 2;
    bits_of(*held, kWhole);
    const std::int64_t floats = VoxelMemory::total() - 2 * fixed;
    bits_of(*halves, kWhole);
    EXPECT_EQ(VoxelMemory::total() - 2 * fixed - floats, floats / 2);
    for (const VoxelBox& box : kBoxes) {
        std::vector<std::uint32_t> rounded = bits_of(*held, box);
        for (std::uint32_t& bits : rounded) {
            const float value =
                round_to_pixel_type(double{std::bit_cast<float>(bits)}, config::PixelType::half);
            bits = std::bit_cast<std::uint32_t>(value);
        }
        EXPECT_EQ(bits_of(*halves, box), rounded);
    }
}

TEST(HeldVoxels, AreMadeOnceWhereBoxesShareRows) {
    const auto source = std::make_shared<CountedVoxels>(sparse_voxel);
    const auto held = held_voxels(source, kSize, kChannels, options_with(kBytes));
    bits_of(*held, {{0, 180, 2}, {700, 60, 2}});
    bits_of(*held, {{0, 180, 2}, {700, 120, 3}});
    EXPECT_EQ(source->made, 700 * (60 * 2 + 60 * 2 + 120));
}

TEST(HeldVoxels, TakeNoMemoryForZeros) {
    const auto zeros = std::make_shared<FunctionVoxels>([](int, int, int, int) { return 0.0F; });
    const auto held = held_voxels(zeros, kSize, kChannels, options_with(kBytes));
    const std::int64_t before = VoxelMemory::total();
    EXPECT_FALSE(held->is_empty(kWhole));
    bits_of(*held, kWhole);
    EXPECT_EQ(VoxelMemory::total(), before);
    EXPECT_TRUE(held->is_empty(kWhole));
}

TEST(HeldVoxels, AreNeverTakenAsEmptyWhereOneIsNot) {
    for (const int x : {0, 7, 8, 511, 512, 699}) {
        const auto one = std::make_shared<FunctionVoxels>([x](int at, int y, int z, int channel) {
            return at == x && y == 17 && z == 3 && channel == 1 ? -0.0F : 0.0F;
        });
        const auto held = held_voxels(one, kSize, kChannels, options_with(kBytes));
        bits_of(*held, kWhole);
        EXPECT_FALSE(held->is_empty(kWhole));
        EXPECT_FALSE(held->is_empty({{x, 17, 3}, {1, 1, 1}}));
        EXPECT_TRUE(held->is_empty({{0, 18, 0}, {700, 282, 5}}));
    }
}

TEST(HeldVoxels, AreMadeOnceAndReadInAnyBox) {
    const auto source = half_empty();
    const auto held = held_voxels(source, kSize, kChannels, options_with(kBytes));
    ASSERT_NE(held, source);
    for (int pass = 0; pass < 2; ++pass) {
        for (const VoxelBox& box : kBoxes) {
            std::vector<float> wanted(static_cast<std::size_t>(box.count()));
            std::vector<float> found(wanted.size());
            FunctionVoxels(sample_voxel).fill(box, {nullptr, wanted.data()});
            held->fill(box, {nullptr, found.data()});
            EXPECT_EQ(found, wanted);
        }
    }
    EXPECT_EQ(source->made, (VoxelBox{{}, kSize}.count()));
}

TEST(HeldVoxels, KnowWhichBoxesAreEmpty) {
    const auto held = held_voxels(half_empty(), kSize, kChannels, options_with(kBytes));
    EXPECT_TRUE(held->is_empty({{}, {700, 300, 2}}));
    EXPECT_FALSE(held->is_empty({{}, {700, 300, 3}}));
}

// To answer may cost a source more than to make the voxels.
TEST(HeldVoxels, AskTheirSourceOnlyOfRowsThatAreNotHeld) {
    const auto source = half_empty();
    const auto held = held_voxels(source, kSize, kChannels, options_with(kBytes));
    const VoxelBox upper{{0, 0, 3}, {700, 300, 2}};
    held->is_empty(upper);
    EXPECT_EQ(source->asked, 1);
    bits_of(*held, upper);
    EXPECT_FALSE(held->is_empty(upper));
    EXPECT_FALSE(held->is_empty({{0, 0, 3}, {700, 1, 1}}));
    EXPECT_EQ(source->asked, 1);
    held->is_empty({{0, 0, 1}, {700, 300, 3}});
    EXPECT_EQ(source->asked, 2);
}

TEST(HeldVoxels, AreMadeOnDemandWhereTheyDoNotFit) {
    const auto source = half_empty();
    EXPECT_EQ(held_voxels(source, kSize, kChannels, options_with(1000)), source);
    EXPECT_EQ(source->made, 0);
    EXPECT_EQ(VoxelMemory::total(), 0);
}

TEST(HeldVoxels, CountTogetherUntilTheyAreReleased) {
    VoxelMemory first(100);
    EXPECT_TRUE(first.take(60));
    {
        VoxelMemory second(100);
        EXPECT_FALSE(second.take(41));
        EXPECT_TRUE(second.take(40));
        EXPECT_EQ(VoxelMemory::total(), 100);
    }
    EXPECT_EQ(VoxelMemory::total(), 60);
}

TEST(HeldVoxels, AreNotHeldWhereNothingMayBe) {
    const auto source = half_empty();
    EXPECT_EQ(held_voxels(source, {1, 1, 1}, 1, options_with(0)), source);
}

}  // namespace
}  // namespace skybake
