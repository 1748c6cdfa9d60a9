// Assets as textures of CalcMySky, which Stellarium's ShowMySky loads: the sizes as 16-bit numbers, then
// four 32-bit floats per texel, little-endian. Channels that the asset lacks are 0.
//
//   a table, or a volume of one slice   two sizes: width, height
//   a volume with sub-images along u    four sizes: those of v, of the sub-images, of u in each of them
//     (Bruneton's tables of scattering) and of w; texels in that order, v fastest
//   any other volume                    four sizes: width, height, 1, depth
//
// So Bruneton's axes (nu and the sun's cosine, the view's cosine, altitude) become CalcMySky's (the
// view's cosine, nu, the sun's cosine, altitude). Texels are moved and not changed.
//
// Source: CalcMySky 0.3, `saveTexture` and `AtmosphereRenderer::loadTexture4D`.
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/little_endian.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t f32_stored = 4;  // numbers per texel

// The order of texels in a file, with `images` sub-images along u; 1: as in memory.
struct F32Layout {
    std::array<int, 3> size{};
    int images = 1;
    bool is_flat = false;

    bool is_turned() const { return images > 1; }
    std::vector<std::uint16_t> sizes() const {
        const auto [u, v, w] = size;
        std::vector<int> all = {u, v};
        if (!is_flat)
            all = is_turned() ? std::vector{v, images, u / images, w} : std::vector{u, v, 1, w};
        return {all.begin(), all.end()};
    }
    // Where a texel of a turned slice lies in the file's slice.
    std::size_t place(int u, int v) const {
        const int each = size[0] / images;
        return (static_cast<std::size_t>(u % each) * static_cast<std::size_t>(images) +
                static_cast<std::size_t>(u / each)) *
                   static_cast<std::size_t>(size[1]) +
               static_cast<std::size_t>(v);
    }
    std::uint64_t texels() const { return static_cast<std::uint64_t>(VoxelBox{{}, size}.count()); }
};

std::string f32_head(const F32Layout& layout) {
    std::string head;
    for (const std::uint16_t number : layout.sizes()) append_little(number, 2, head);
    return head;
}

int images_of(const Baked& baked) {
    const std::string text = fact_named(baked.details, "nu_size");
    int images = 1;
    std::from_chars(text.data(), text.data() + text.size(), images);
    return images;
}

// The pieces of a level in the order of the file: whole slices where texels are turned.
std::vector<VoxelBox> pieces_of(const F32Layout& layout) {
    std::vector<VoxelBox> boxes;
    if (layout.is_turned()) {
        for (int w = 0; w < layout.size[2]; ++w) {
            boxes.push_back({{0, 0, w}, {layout.size[0], layout.size[1], 1}});
        }
        return boxes;
    }
    const BoxSequence sequence(layout.size, static_cast<int>(f32_stored));
    for (int i = 0; i < sequence.count(); ++i) boxes.push_back(sequence[i]);
    return boxes;
}

void fill_piece(const Level& level, std::size_t channels, const VoxelBox& box,
                const F32Layout& layout, std::vector<float>& texels) {
    const auto count = static_cast<std::size_t>(box.count());
    std::vector<float> planes(count * channels);
    std::vector<float*> to;
    for (std::size_t c = 0; c < channels; ++c) to.push_back(&planes[c * count]);
    level.voxels->fill(box, to);
    texels.assign(count * f32_stored, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = i / static_cast<std::size_t>(box.size[0]);
        const std::size_t column = i % static_cast<std::size_t>(box.size[0]);
        const std::size_t at =
            layout.is_turned() ? layout.place(static_cast<int>(column), static_cast<int>(row)) : i;
        for (std::size_t c = 0; c < channels; ++c) texels[at * f32_stored + c] = to[c][i];
    }
}

Outcome<bool> write_f32_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    const std::size_t channels = baked.channel_names.size();
    if (channels > f32_stored || baked.pixel_type != PixelType::float32) {
        return contradiction(path, "f32 files hold at most four channels of float");
    }
    const Level& level = baked.levels[static_cast<std::size_t>(content.level)];
    const F32Layout layout = {level.size, images_of(baked), level.size[2] == 1};
    FileOutput output(path);
    output.write(f32_head(layout));
    std::vector<float> texels;
    bool complete = true;
    for (const VoxelBox& box : pieces_of(layout)) {
        complete = !is_cancelled(content.progress) && output.error() == 0;
        if (!complete) break;
        fill_piece(level, channels, box, layout, texels);
        output.write({reinterpret_cast<const char*>(texels.data()), texels.size() * sizeof(float)});
    }
    return output.finished(complete);
}

// Finds the layout whose head the file has; none: another one.
std::optional<F32Layout> layout_in(FileInput& file, const FileShape& shape) {
    const auto head = file_part(file, 0, 8);
    if (!head) return std::nullopt;
    F32Layout layout = {shape.size, 1, shape.size[2] == 1};
    if (!layout.is_flat) {
        const auto images = static_cast<int>(little(*head, 2, 2));
        if (*head != f32_head(layout)) layout.images = images;
        if (layout.images < 1 || shape.size[0] % layout.images != 0) return std::nullopt;
    }
    const std::string wanted = f32_head(layout);
    const std::uint64_t bytes = wanted.size() + layout.texels() * f32_stored * sizeof(float);
    if (!head->starts_with(wanted) || file.size() != bytes) return std::nullopt;
    return layout;
}

Outcome<bool> read_turned(FileInput& file, const F32Layout& layout, std::size_t channels,
                          const VoxelVisitor& visit) {
    const auto count =
        static_cast<std::size_t>(layout.size[0]) * static_cast<std::size_t>(layout.size[1]);
    std::vector<float> slice(count * f32_stored);
    std::vector<float> values(count * channels);
    const TexelInput next = texel_input(file, f32_head(layout).size());
    for (int w = 0; w < layout.size[2]; ++w) {
        if (auto problem =
                next(reinterpret_cast<char*>(slice.data()), slice.size() * sizeof(float))) {
            return std::move(*problem);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto u = static_cast<int>(i % static_cast<std::size_t>(layout.size[0]));
            const auto v = static_cast<int>(i / static_cast<std::size_t>(layout.size[0]));
            std::memcpy(&values[i * channels], &slice[layout.place(u, v) * f32_stored],
                        channels * sizeof(float));
        }
        const auto texels = static_cast<std::int64_t>(count);
        if (!visit(w * texels, texels, values.data())) return {false, {}};
    }
    return {true, {}};
}

Outcome<bool> read_f32_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    const auto layout = layout_in(file, shape);
    if (!layout || shape.channels > f32_stored) return other_size(file.path());
    if (layout->is_turned()) return read_turned(file, *layout, shape.channels, visit);
    return read_texels(texel_input(file, f32_head(*layout).size()),
                       {shape.size, shape.channels, f32_stored, PixelType::float32}, visit);
}

}  // namespace

Format f32_format() {
    return {.format = config::FileFormat::f32,
            .has_metadata = false,
            .write = write_f32_file,
            .inspect = nullptr,
            .read = read_f32_file};
}

}  // namespace skybake
