#include "bakers/field/choose_probes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/field/readable_texture.h"

namespace skybake {
namespace {

// 0 but for one texel.
Image2<float> spot(int x, int y, int edge = 16) {
    Image2<float> image(edge, edge, 1);
    image.texel(x, y)[0] = 1;
    return image;
}

ProbedTexture texture_of(const Image2<float>& image) {
    return {testing::readable_texture(image), 2, config::PixelType::float32, {1}};
}

// Places where the spot is seen from `from` on only; else where nothing is.
ProbeSpace space_that_sees(double from, int edge) {
    ProbeSpace space;
    space.place = [from, edge](const std::array<double, 3>& wanted) {
        const double u =
            wanted[0] >= from ? (3.2 + 0.4 * wanted[0]) / edge : 0.9 + 0.01 * wanted[0];
        const std::array<double, 3> uvw = {u, 5.3 / edge, 0.5};
        return ProbePlace{{{"x", uvw[0]}}, {{uvw}}};
    };
    for (int i = 0; i < 16; ++i) space.wanted.push_back({i / 16.0, 0.5, 0});
    return space;
}

// A space of which one place of sixteen sees the spot, and none next to it does.
ProbeSpace space_that_sees_once(int edge) {
    ProbeSpace one = space_that_sees(15 / 16.0, edge);
    one.place = [seen = one.wanted[7], place = one.place](const std::array<double, 3>& wanted) {
        return place({wanted == seen ? 1.0 : 0.0, 0.5, 0});
    };
    return one;
}

TEST(ChooseProbes, RefusesASetThatAWrongFilePasses) {
    constexpr int kEdge = 512;  // more texels than are looked at one by one
    const Image2<float> image = spot(3, 5, kEdge);
    const ProbeSet blind = take_probes(texture_of(image), {space_that_sees_once(kEdge)}, 8, {});
    EXPECT_EQ(std::count(blind.missed.begin(), blind.missed.end(), "zeros"), 1);
    EXPECT_EQ(std::count(blind.catches.begin(), blind.catches.end(), "zeros"), 0);
    const auto problem = weak_probes("spot", blind);
    ASSERT_TRUE(problem.has_value());
    EXPECT_EQ(problem->code, "E0407");
    EXPECT_NE(problem->message.find("`spot`"), std::string::npos);
    EXPECT_NE(problem->message.find("flip_u"), std::string::npos) << problem->message;

    const ProbeSet seeing = take_probes(texture_of(image), {space_that_sees(0.5, kEdge)}, 8, {});
    EXPECT_TRUE(seeing.missed.empty());
    EXPECT_FALSE(weak_probes("spot", seeing).has_value());
    for (const char* fault : {"zeros", "flip_u", "flip_v", "swap_uv", "shift_u", "shift_v"}) {
        EXPECT_EQ(std::count(seeing.catches.begin(), seeing.catches.end(), fault), 1) << fault;
    }
}

// A small texture is looked at in every texel. Where that finds no more places, the asset has no
// more, and the probe that there is must be taken.
TEST(ChooseProbes, TakesTheOnlyPlaceOfASmallTexture) {
    const Image2<float> image = spot(3, 5);
    const ProbeSet set = take_probes(texture_of(image), {space_that_sees_once(16)}, 8, {});
    EXPECT_FALSE(weak_probes("spot", set).has_value());
    EXPECT_EQ(std::count(set.catches.begin(), set.catches.end(), "zeros"), 0);
    EXPECT_EQ(std::count_if(set.probes.begin(), set.probes.end(),
                            [](const TakenProbe& probe) { return probe.value.value[0] > 0.1; }),
              1);
}

TEST(ChooseProbes, LooksIntoEveryTexelOfTexturesThatAreNotLarge) {
    for (const int edge : {16, 65, 256}) {
        const Image2<float> image = spot(3, 5, edge);
        ProbeSpace space;
        space.place = [edge](const std::array<double, 3>& wanted) {
            // Places are known by texel, as those of nearest lookups are: none is next to another.
            const double u = (std::floor(wanted[0] * edge) + 0.25) / edge;
            const double v = (std::floor(wanted[1] * edge) + 0.25) / edge;
            return ProbePlace{{{"x", u}}, {{{u, v, 0.5}}}};
        };
        space.wanted = {{0.9, 0.9, 0}, {3.5 / edge, 5.5 / edge, 0}};
        const ProbeSet set = take_probes(texture_of(image), {space}, 3, {});
        EXPECT_TRUE(set.missed.empty()) << edge;
        EXPECT_EQ(std::count(set.catches.begin(), set.catches.end(), "zeros"), 1) << edge;
    }
}

// Where a fault shows at one place, those next to it are looked at.
TEST(ChooseProbes, LooksAboutALonelyPlace) {
    const Image2<float> image = spot(3, 5);
    ProbeSpace space;
    space.place = [](const std::array<double, 3>& wanted) {
        return ProbePlace{{{"x", wanted[0]}}, {{{wanted[0], wanted[1], 0.5}}}};
    };
    space.wanted = {{0.9, 0.9, 0}, {0.8, 0.1, 0}, {3.4 / 16, 5.3 / 16, 0}};
    const ProbeSet set = take_probes(texture_of(image), {space}, 3, {});
    EXPECT_TRUE(set.missed.empty());
    EXPECT_EQ(std::count(set.catches.begin(), set.catches.end(), "zeros"), 1);
    EXPECT_GE(std::count_if(set.probes.begin(), set.probes.end(),
                            [](const TakenProbe& probe) { return probe.value.value[0] > 0.1; }),
              kSeveralProbes);
}

// Interrupts when it has been asked so many times.
class CancelsAfter : public Progress {
  public:
    explicit CancelsAfter(int asked) : left_(asked) {}
    void advance(std::string_view, double) override {}
    bool cancelled() const override { return --left_ < 0; }

  private:
    mutable int left_;
};

TEST(ChooseProbes, CanBeInterruptedAtAnyStep) {
    const Image2<float> image = spot(3, 5);
    ProbeSpace space = space_that_sees_once(16);
    std::size_t probes = 0;
    int asked = 0;
    while (probes == 0) {
        CancelsAfter progress(asked++);
        probes = take_probes(texture_of(image), {space}, 8, {1, {}, &progress}).probes.size();
    }
    EXPECT_GE(asked, 4);
}

// Each of several tables one below the other has its share.
TEST(ChooseProbes, TakesSomeOfEachSpace) {
    Image2<float> image(8, 8, 1);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        image.texels[i] = static_cast<float>((i * 37) % 101);
    }
    std::vector<ProbeSpace> spaces(4);
    for (std::size_t part = 0; part < spaces.size(); ++part) {
        spaces[part].place = [part](const std::array<double, 3>& wanted) {
            const double v = (static_cast<double>(part) + wanted[1]) / 4;
            return ProbePlace{{{"part", static_cast<double>(part)}}, {{{wanted[0], v, 0.5}}}};
        };
        for (int i = 0; i < 20; ++i)
            spaces[part].wanted.push_back({i / 20.0, i * 7 % 20 / 20.0, 0});
    }
    const ProbeSet set = take_probes(texture_of(image), spaces, 24, {});
    for (int part = 0; part < 4; ++part) {
        EXPECT_GE(std::count_if(
                      set.probes.begin(), set.probes.end(),
                      [part](const TakenProbe& probe) { return probe.place.at[0].second == part; }),
                  6);
    }
}

}  // namespace
}  // namespace skybake
