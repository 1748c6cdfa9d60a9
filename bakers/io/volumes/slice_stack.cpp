#include "bakers/io/volumes/slice_stack.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/png/image_codec.h"
#include "bakers/io/formats/png/map_image.h"
#include "bakers/io/volumes/raw_volume.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

Diagnostic not_a_slice(const fs::path& path, const std::string& reason) {
    return file_error(
        "E0304", path.string(),
        fmt::format("cannot read `{}` as a slice of a volume: {}", path.string(), reason));
}

Outcome<MapPixels> read_slice(const fs::path& path, const std::string& channel,
                              config::NotFinite not_finite) {
    const Outcome<FileInput> opened = FileInput::open(path);  // says why it cannot be
    if (!opened.value) return {{}, opened.diagnostics};
    const LoadedCodec<ImageCodec>& loaded = image_codec();
    if (loaded.codec == nullptr) {
        return {{},
                {file_error("E0300", path.string(),
                            fmt::format("cannot read `{}`: {}", path.string(), loaded.reason))}};
    }
    const auto parts = read_exr_heads(path);
    const std::string subsampled = parts.value ? subsampled_channel(*parts.value) : "";
    if (!subsampled.empty()) return {{}, {not_a_slice(path, subsampled)}};
    MapPixels pixels = loaded.codec->read(path, channel, 1);
    if (!pixels.problem.empty()) return {{}, {not_a_slice(path, pixels.problem)}};
    if (pixels.values.empty()) {
        return {{},
                {not_a_slice(path, fmt::format("it has no channel `{}`, only `{}`", channel,
                                               fmt::join(pixels.channel_names, "`, `")))}};
    }
    const auto worst = std::find_if(pixels.values.begin(), pixels.values.end(),
                                    [](float value) { return !std::isfinite(value); });
    if (not_finite == config::NotFinite::refuse && worst != pixels.values.end()) {
        const auto at = worst - pixels.values.begin();
        return {{},
                {not_a_slice(path, fmt::format("the pixel in column {}, row {} is {}; not_finite = "
                                               "\"background\" takes 0 in its place",
                                               at % pixels.width, at / pixels.width, *worst))}};
    }
    return {std::move(pixels), {}};
}

// A file that has no name once it is open, so that it goes when the program does.
class ScratchFile {
  public:
    ScratchFile() {
        std::string path = (fs::temp_directory_path() / "skybake-XXXXXX").string();
        file_ = FileDescriptor(::mkstemp(path.data()));
        if (file_.valid()) fs::remove(path);
    }
    fs::path path() const { return fmt::format("/proc/self/fd/{}", file_.get()); }

  private:
    FileDescriptor file_;
};

}  // namespace

Outcome<FileVoxels> open_slice_stack(std::span<const fs::path> paths, const std::string& channel,
                                     VolumePart part, config::NotFinite not_finite) {
    Outcome<MapPixels> slice = read_slice(paths[0], channel, not_finite);
    if (!slice.value) return {{}, std::move(slice.diagnostics)};
    RawLayout layout;
    layout.size = {slice.value->width, slice.value->height, static_cast<int>(paths.size())};
    layout.byte_order = std::endian::native == std::endian::little ? config::ByteOrder::little
                                                                   : config::ByteOrder::big;
    if (part == VolumePart::shape) {
        FileVoxels voxels;
        voxels.size = layout.size;
        return {std::move(voxels), {}};
    }
    const ScratchFile scratch;
    FileOutput output(scratch.path());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (i > 0) slice = read_slice(paths[i], channel, not_finite);
        if (!slice.value) return {{}, std::move(slice.diagnostics)};
        const MapPixels& pixels = *slice.value;
        if (pixels.width != layout.size[0] || pixels.height != layout.size[1]) {
            return {{},
                    {not_a_slice(
                        paths[i],
                        fmt::format("it has {} x {} pixels, and the first slice {} x {}",
                                    pixels.width, pixels.height, layout.size[0], layout.size[1]))}};
        }
        output.write({reinterpret_cast<const char*>(pixels.values.data()),
                      pixels.values.size() * sizeof(float)});
    }
    if (!output.finish()) return {{}, {output.diagnostic()}};
    return open_raw_volume(scratch.path(), layout, part, not_finite);
}

}  // namespace skybake
