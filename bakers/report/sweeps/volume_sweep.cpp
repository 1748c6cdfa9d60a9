#include "bakers/report/sweeps/volume_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bakers/io/files/to_string.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/sections/file_formats.h"
#include "config/sections/files.h"

namespace skybake {

using config::Compression;
using config::FileFormat;
using config::PixelType;
using config::VdbCompression;
using Voxels = std::shared_ptr<const VoxelSource>;

namespace {

class StorageSweep {
  public:
    StorageSweep(const VolumeSubject& subject, Voxels own, bool quick)
        : subject_(subject), files_(subject.files), own_(std::move(own)), quick_(quick) {}

    VolumeSweep make() {
        add_compressions();
        add_sizes();
        add_blocks();
        return std::move(sweep_);
    }

  private:
    bool is_asked_for(FileFormat format) const {
        return subject_.of_recipe_size && std::find(files_.formats.begin(), files_.formats.end(),
                                                    format) != files_.formats.end();
    }

    // EXR and VDB hold float and half. If the recipe asks for another type, they are shown with half.
    void add_compressions() {
        const bool is_held = config::floating_types.contains(files_.pixel_type);
        const PixelType type = is_held ? files_.pixel_type : PixelType::half;
        for (const Compression compression :
             {Compression::none, Compression::zip, Compression::zips, Compression::piz}) {
            VolumeVariant& variant = add_variant(sweep_, fmt::format("exr, {}", to_string(type)),
                                                 fmt::format("exr {}", to_string(compression)),
                                                 own_, subject_.size, type);
            variant.format = FileFormat::exr;
            variant.compression = compression;
            variant.of_recipe = is_asked_for(FileFormat::exr) && compression == files_.compression;
        }
        for (const VdbCompression compression :
             {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
            VolumeVariant& variant = add_variant(sweep_, fmt::format("vdb, {}", to_string(type)),
                                                 fmt::format("vdb {}", to_string(compression)),
                                                 own_, subject_.size, type);
            variant.format = FileFormat::vdb;
            variant.vdb_compression = compression;
            variant.of_recipe =
                is_asked_for(FileFormat::vdb) && compression == files_.vdb_compression;
        }
    }

    std::vector<std::array<int, 3>> sizes() {
        std::vector<std::array<double, 3>> factors;
        for (const double factor : {0.5, 0.75, 1.0, 1.5, 2.0}) {
            factors.push_back({factor, factor, factor});
        }
        std::vector<std::array<int, 3>> all =
            sizes_around(subject_.size, factors, max_report_values(quick_) / subject_.channels);
        std::erase_if(all, [&](const std::array<int, 3>& size) {
            const std::string refusal = subject_.refusal ? subject_.refusal(size) : "";
            if (!refusal.empty()) {
                sweep_.notes.push_back(fmt::format("{}: left out, {}", size_text(size), refusal));
            }
            return !refusal.empty();
        });
        return all;
    }

    // Adds sizes in all pixel types, uncompressed so that their bytes can be compared.
    void add_sizes() {
        std::vector<std::pair<std::array<int, 3>, Voxels>> volumes;
        for (const std::array<int, 3>& size : sizes()) {
            volumes.emplace_back(size, size == subject_.size ? own_ : subject_.make_voxels(size));
        }
        for (const PixelType type :
             {PixelType::float32, PixelType::half, PixelType::unorm16, PixelType::unorm8}) {
            for (const auto& [size, voxels] : volumes) {
                VolumeVariant& variant =
                    add_variant(sweep_, fmt::format("bin, {}", to_string(type)), size_text(size),
                                voxels, size, type);
                const bool own_size = size == subject_.size;
                variant.in_quadrature_sweep = own_size && type == PixelType::float32;
                variant.of_recipe =
                    own_size && is_asked_for(FileFormat::bin) && type == files_.pixel_type;
            }
        }
    }

    // Adds the types that code blocks and have as many channels, in the size of the recipe: bytes on
    // the GPU that cost accuracy, as fewer voxels do.
    void add_blocks() {
        struct Blocks {
            FileFormat format;
            PixelType type;
        };
        for (const auto& [format, type] :
             {Blocks{FileFormat::dds, PixelType::bc4}, Blocks{FileFormat::dds, PixelType::bc6h},
              Blocks{FileFormat::nvdb, PixelType::fp16},
              Blocks{FileFormat::nvdb, PixelType::fp8}}) {
            const std::size_t channels = config::coded_channels(type);
            const bool fits =
                channels == 0 || static_cast<std::int64_t>(channels) == subject_.channels;
            if (!fits) continue;
            VolumeVariant& variant =
                add_variant(sweep_, fmt::format("{}, {}", to_string(format), to_string(type)),
                            size_text(subject_.size), own_, subject_.size, type);
            variant.format = format;
            variant.of_recipe = is_asked_for(format) && type == files_.pixel_type;
        }
    }

    const VolumeSubject& subject_;
    const config::AssetFiles& files_;
    Voxels own_;
    bool quick_;
    VolumeSweep sweep_;
};

}  // namespace

std::int64_t max_report_values(bool quick) {
    return quick ? std::int64_t{1} << 23 : std::int64_t{1} << 26;
}

VolumeVariant& add_variant(VolumeSweep& sweep, std::string family, std::string name,
                           std::shared_ptr<const VoxelSource> voxels,
                           const std::array<int, 3>& size, PixelType pixel_type) {
    VolumeVariant variant;
    variant.family = std::move(family);
    variant.name = std::move(name);
    variant.voxels = std::move(voxels);
    variant.size = size;
    variant.pixel_type = pixel_type;
    sweep.variants.push_back(std::move(variant));
    return sweep.variants.back();
}

VolumeSweep storage_sweep(const VolumeSubject& subject, const Voxels& own, bool quick) {
    return StorageSweep(subject, own, quick).make();
}

}  // namespace skybake
