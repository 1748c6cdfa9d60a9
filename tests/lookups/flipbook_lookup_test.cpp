// Flipbooks, as textures of a layer per frame and as sheets of cells.
#include "tests/lookups/lookup_trial.h"
#include "tests/support/loops.h"

namespace skybake {
namespace gpu::flipbook_lookups {
#include "lookups/flipbook.glsl.h"
}  // namespace gpu::flipbook_lookups

namespace {

using gpu::vec2;
using gpu::vec4;

// Five frames of 24 x 20 texels.
test::BakedLookup bake_book() {
    return test::bake_all(
        "[noise.n]\nperiod = 5\n[noise.n.channels.R]\ntype = 'perlin'\nfrequency = [3, 2, 1]\n"
        "[noise.n.channels.G]\ntype = 'worley'\nfrequency = [3, 4, 1]\n"
        "[noise.n.channels.B]\ntype = 'perlin'\nfrequency = [2, 2, 1]\n"
        "[bake.w]\nasset = 'weather_map'\nnoise = 'n'\nsize = [24, 20]\nframes = 5\n"
        "[bake.a]\nasset = 'flipbook'\nof = 'w'\npixel_type = 'float'\nformats = ['exr']\n");
}

const Baked& book_of(const test::BakedLookup& baked) { return baked.assets.back(); }

// The value of an empty cell here. A lookup in float takes 2e-6 of the texel beside its own.
constexpr float kEmpty = 5;

// Cell k of a sheet stands at column k mod columns of row k / columns from the top left.
Texture sheet_of(const Texture& book, int columns, int rows) {
    Texture sheet = book;
    const auto [width, height, frames] = book.size;
    sheet.size = {width * columns, height * rows, 1};
    sheet.texels.assign(sheet.texels.size() / static_cast<std::size_t>(frames) *
                            static_cast<std::size_t>(columns * rows),
                        kEmpty);
    const auto channels = static_cast<std::size_t>(book.channels);
    testing::for_each_voxel({width, height, frames}, [&](int x, int y, int frame) {
        const int row = frame / columns * height + y;
        const int column = frame % columns * width + x;
        for (int c = 0; c < book.channels; ++c) {
            const auto to = static_cast<std::size_t>(row * sheet.size[0] + column);
            sheet.texels[to * channels + static_cast<std::size_t>(c)] =
                book.texel({x, y, frame}, c);
        }
    });
    return sheet;
}

// The largest difference between a lookup and that of the texture, of numbers from -12 to 12, with the
// frame and the columns shifted for the former.
template <class Lookup>
double difference(const Texture& book, float later, float flip, const Lookup& lookup) {
    test::Dice dice;
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const vec2 uv(dice.uniform(-2, 3), dice.uniform(-2, 3));
        const auto frame = static_cast<float>(dice.uniform(-12, 12));
        const vec4 wanted =
            gpu::flipbook_lookups::flipbook({book}, gpu::size_of(book).z, uv, frame);
        const vec4 found = lookup(vec2(flip * uv.x, uv.y), frame + later);
        for (int c = 0; c < 3; ++c) {
            const double apart = std::fabs(double{wanted[c]} - double{found[c]});
            if (!(apart <= largest)) largest = apart;
        }
    }
    return largest;
}

// Holds it to the texture's, and sees that it would tell other frames and a mirrored picture.
template <class Lookup>
void expect_same(const Texture& book, const Lookup& lookup) {
    EXPECT_LT(difference(book, 0, 1, lookup), 2e-5);
    EXPECT_GT(difference(book, 1, 1, lookup), 0.2) << "a frame too late";
    EXPECT_GT(difference(book, -0.5f, 1, lookup), 0.1) << "half a frame too early";
    EXPECT_GT(difference(book, 0, -1, lookup), 0.2) << "mirrored";
}

// The sampler of an array does not repeat along the layers.
TEST(FlipbookLookup, OfLayersIsThatOfTheTexture) {
    const test::BakedLookup baked = bake_book();
    const Texture book = texture_of(book_of(baked));
    Texture layers = book;
    layers.repeats[2] = false;
    expect_same(book, [&](const vec2& uv, float frame) {
        return gpu::flipbook_lookups::flipbook_layers({layers}, gpu::size_of(layers).z, uv, frame);
    });
}

// Tests a full sheet, and one whose last cell is empty and would show.
TEST(FlipbookLookup, OfASheetIsThatOfTheTexture) {
    const test::BakedLookup baked = bake_book();
    const Texture book = texture_of(book_of(baked));
    for (const auto& [columns, rows] : {std::pair{5, 1}, {1, 5}, {3, 2}, {2, 3}}) {
        SCOPED_TRACE(columns);
        const vec2 cells(columns, rows);
        const auto lookup_of = [&](const Texture& sheet) {
            return [&](const vec2& uv, float frame) {
                return gpu::flipbook_lookups::flipbook_sheet({sheet}, vec2(gpu::size_of(sheet)), 5,
                                                             uv, frame, cells);
            };
        };
        const Texture sheet = sheet_of(book, columns, rows);
        expect_same(book, lookup_of(sheet));
        const Texture turned = sheet_of(book, rows, columns);
        EXPECT_GT(difference(book, 0, 1, lookup_of(turned)), 0.2) << "columns for rows";
    }
}

}  // namespace
}  // namespace skybake
