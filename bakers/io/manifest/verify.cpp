#include "bakers/io/manifest/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "bakers/field/finish_table.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/value_kernel.h"
#include "bakers/field/voxel_index.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/compare.h"
#include "bakers/io/manifest/examination.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

std::vector<ProbeLookup> lookups_of(const Probe& probe) {
    if (!probe.blend) return {{probe.uvw}};
    return {{probe.uvw, 1 - probe.blend->share}, {probe.blend->uvw, probe.blend->share}};
}

// Visits a file's voxels once, in order, and keeps what the checks need.
class VoxelCheck {
  public:
    VoxelCheck(const ManifestLevel& level, const TextureUse& use, int dimensions,
               std::size_t channels, PixelType type)
        : level_(level),
          use_(use),
          dimensions_(dimensions),
          channels_(channels),
          type_(type),
          min_(channels, std::numeric_limits<double>::infinity()),
          max_(channels, -std::numeric_limits<double>::infinity()) {
        for (const Probe& probe : level.probes) {
            for (const ProbeLookup& lookup : lookups_of(probe)) {
                want(use, lookup.uvw);
                for (const WrongLookup& wrong : wrong_lookups(use, dimensions_)) {
                    want(wrong.use, wrong.place(lookup.uvw));
                }
            }
        }
        std::ranges::sort(wanted_);
        wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
        kept_.reserve(wanted_.size() * channels);
    }

    void add(std::int64_t first, std::int64_t count, const float* values) {
        const auto total = static_cast<std::size_t>(count) * channels_;
        constexpr float kMost = std::numeric_limits<float>::max();
        const bool as_they_are = channels_ == 1 && are_within(values, total, -kMost, kMost);
        for (std::size_t c = 0; c < channels_; ++c) {
            const std::span<const float> finite =
                as_they_are ? std::span(values, total) : finite_values(values, total, c);
            not_finite_ += count - std::ssize(finite);
            LaneSummary lanes;
            add_values(finite.data(), finite.size(), lanes);
            min_[c] = std::min(min_[c], *std::ranges::min_element(lanes.least));
            max_[c] = std::max(max_[c], *std::ranges::max_element(lanes.most));
        }
        bytes_.resize(total * bytes_per_value(type_));
        store_values(values, total, type_, bytes_.data());
        hasher_.update(bytes_);
        // Both the voxels and the list of wanted voxels are in order.
        while (next_ < wanted_.size() && wanted_[next_] < first + count) {
            const auto at = static_cast<std::size_t>(wanted_[next_++] - first) * channels_;
            kept_.insert(kept_.end(), values + at, values + at + channels_);
        }
    }

    void report(Examination& examination, const ManifestAsset& asset) const {
        examination.expect(not_finite_ == 0, "finite",
                           fmt::format("{} values are NaN or infinite", not_finite_));
        examination.expect_equal(hasher_.hex(), level_.content_hash, "content_hash",
                                 "the hash of the voxels");
        for (std::size_t c = 0; c < channels_; ++c) {
            const std::string name = fmt::format("of channel {}", asset.channels[c]);
            examination.expect_equal(min_[c], level_.statistics[c].min, "statistics",
                                     fmt::format("the smallest value {}", name));
            examination.expect_equal(max_[c], level_.statistics[c].max, "statistics",
                                     fmt::format("the largest value {}", name));
        }
        const ReadableTexture texture = kept_texture();
        std::vector<CaughtProbe> probes;
        for (const Probe& probe : level_.probes) {
            probes.push_back({lookups_of(probe), probe.value, probe.tolerance});
            check_within(examination, probe);
            check_lookup(examination, place_text(probe.at), look_up(texture, probes.back().lookups),
                         probe.value, probe.tolerance);
        }
        check_catches(examination, texture, dimensions_, probes, level_.catches);
    }

  private:
    std::span<const float> finite_values(const float* values, std::size_t total,
                                         std::size_t channel) {
        finite_.clear();
        for (std::size_t i = channel; i < total; i += channels_) {
            if (std::isfinite(values[i])) finite_.push_back(values[i]);
        }
        return finite_;
    }

    // Checks that the texture coordinates lie within the texture along axes that do not repeat.
    void check_within(Examination& examination, const Probe& probe) const {
        bool within = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = probe.uvw[axis];
            within = within && (use_.repeats[axis] || (at >= 0 && at <= 1));
        }
        examination.expect(within, "probe",
                           fmt::format("uvw ({}) of {} is outside of [0, 1]",
                                       fmt::join(probe.uvw, ", "), place_text(probe.at)));
    }

    void want(const TextureUse& use, const std::array<double, 3>& uvw) {
        for (const VoxelTap& tap : lookup_taps(use, uvw)) {
            wanted_.push_back(index_in({{}, level_.size}, tap.voxel));
        }
    }

    // Returns a texture of the voxels that were kept: all that the probes look up.
    ReadableTexture kept_texture() const {
        const auto read = [this](const std::array<VoxelTap, 8>& taps, float* values) {
            for (const VoxelTap& tap : taps) {
                const std::int64_t index = index_in({{}, level_.size}, tap.voxel);
                const auto found = std::ranges::lower_bound(wanted_, index);
                const auto at = static_cast<std::size_t>(found - wanted_.begin()) * channels_;
                values = std::copy_n(&kept_[at], channels_, values);
            }
        };
        return {use_, channels_, read};
    }

    const ManifestLevel& level_;
    const TextureUse use_;
    const int dimensions_;
    const std::size_t channels_;
    const PixelType type_;
    std::vector<double> min_;
    std::vector<double> max_;
    std::int64_t not_finite_ = 0;
    std::vector<float> finite_;
    Hasher hasher_;
    std::string bytes_;
    std::vector<std::int64_t> wanted_;  // the voxels that probes look up, sorted
    std::vector<float> kept_;           // their values, in that order
    std::size_t next_ = 0;
};

// Checks what the file says of itself.
void check_facts(Examination& examination, const FileFacts& facts, const ManifestAsset& asset,
                 const ManifestFile& file) {
    examination.expect_equal(to_string(facts.pixel_type.value_or(file.pixel_type)),
                             to_string(file.pixel_type), "pixel_type", "the pixel type");
    if (!facts.names.empty()) {
        const std::vector<std::string>& wanted = file.grids.empty() ? asset.channels : file.grids;
        examination.expect_equal(facts.names, wanted, "channels", "the list of channels");
    }
    if (!facts.compression.empty()) {
        examination.expect_equal(facts.compression, file.compression, "compression",
                                 "the compression");
    }
    if (file.layout) {
        const std::array<int, 3>& size = asset.levels[static_cast<std::size_t>(file.level)].size;
        examination.expect_equal(facts.image_size, image_size(size, *file.layout), "size",
                                 "the size of the image");
        const std::int64_t cells = std::int64_t{file.layout->columns} * file.layout->rows;
        examination.expect(cells >= size[2] && cells - file.layout->columns < size[2], "layout",
                           fmt::format("{} x {} cells are not those of {} slices",
                                       file.layout->columns, file.layout->rows, size[2]));
    }
}

void check_metadata(Examination& examination, const std::string& found, const std::string& wanted) {
    if (!examination.expect(!found.empty(), "metadata", "the file carries none")) return;
    const auto differences = metadata_differences(found, wanted);
    const auto text = [](const std::optional<std::string>& value) {
        constexpr std::size_t most = 80;
        return value ? fmt::format("`{}`", value->substr(0, most)) : "missing";
    };
    examination.expect(differences.empty(), "metadata",
                       differences.empty()
                           ? ""
                           : fmt::format("{} is {}, but the manifest says {}", differences[0].name,
                                         text(differences[0].first), text(differences[0].second)));
}

void check_voxels(Examination& examination, const std::filesystem::path& path,
                  const ManifestAsset& asset, const ManifestFile& file) {
    const auto first = static_cast<std::size_t>(file.level);
    for (int i = 0; i < file.levels; ++i) {
        const ManifestLevel& level = asset.levels[first + static_cast<std::size_t>(i)];
        const TextureUse use = {level.size, repeating_axes(asset.axes),
                                is_looked_up_nearest(asset.axes)};
        VoxelCheck voxels(level, use, static_cast<int>(asset.axes.size()), asset.channels.size(),
                          file.pixel_type);
        const auto visit = [&voxels](std::int64_t at, std::int64_t count, const float* values) {
            voxels.add(at, count, values);
            return true;
        };
        if (examination.expect_read(read_asset_file(path, asset, file, i, visit), "voxels")) {
            voxels.report(examination, asset);
        }
    }
}

void check_content(Examination& examination, const std::filesystem::path& path,
                   const ManifestAsset& asset, const ManifestFile& file) {
    const Format* format = find_format(file.format);
    if (format == nullptr) return;  // a text, checked by its hash
    if (format->inspect) {
        Outcome<FileInput> input = FileInput::open(path);
        const Outcome<FileFacts> facts =
            input.value ? format->inspect(*input.value) : Outcome<FileFacts>{{}, input.diagnostics};
        if (!examination.expect_read(facts, "format")) return;
        check_facts(examination, *facts.value, asset, file);
        if (format->has_metadata) {
            check_metadata(examination, facts.value->metadata, file_entry_json(asset, file));
        }
    }
    if (format->read != nullptr) check_voxels(examination, path, asset, file);
}

void check_further(VerifyReport& report, const ManifestAsset& asset,
                   std::span<const AssetCheck> further) {
    Examination examination(report, asset.files.empty() ? asset.name : asset.files.front().path);
    for (const AssetCheck& check : further) {
        int checks = 0;
        for (const std::string& message : check.run(asset, checks)) {
            examination.fail(check.name, message);
        }
        examination.count(checks);
    }
}

void check_file(VerifyReport& report, const std::filesystem::path& folder,
                const ManifestAsset& asset, const ManifestFile& file) {
    ++report.files;
    Examination examination(report, file.path);
    const std::filesystem::path path = folder / file.path;
    const Outcome<FileFingerprint> found = fingerprint(path);
    if (!examination.expect_read(found, "file")) return;
    examination.expect_equal(found.value->bytes, file.bytes, "bytes", "the number of bytes");
    examination.expect_equal(found.value->xxh3, file.xxh3, "xxh3", "the hash of the file");
    check_content(examination, path, asset, file);
}

// Checks that the entries and the rest of the manifest are as they were written. Edits by hand show
// nowhere else.
void check_manifest(VerifyReport& report, const std::string& name, const Manifest& manifest) {
    Examination examination(report, name);
    const std::size_t hashes = manifest.assets.size() + 1;
    examination.count(static_cast<int>(hashes));
    for (const std::string& alteration : manifest.alterations) {
        examination.fail("hash", alteration);
    }
}

double bytes_of(const ManifestAsset& asset) {
    double bytes = 0;
    for (const ManifestFile& file : asset.files) bytes += static_cast<double>(file.bytes);
    return bytes;
}

}  // namespace

Outcome<VerifyReport> verify_bake(const std::filesystem::path& path,
                                  std::span<const AssetCheck> further,
                                  std::span<const FolderCheck> of_folder, Progress* progress) {
    const ManifestPlace place = manifest_place(path);
    Outcome<Manifest> manifest = read_manifest_file(place.file);
    if (!manifest.value) return {{}, std::move(manifest.diagnostics)};
    VerifyReport report;
    check_manifest(report, place.file.filename().string(), *manifest.value);
    double bytes_left = 0;
    for (const ManifestAsset& asset : manifest.value->assets) bytes_left += bytes_of(asset);
    const double bytes = std::max(bytes_left, 1.0);
    for (const ManifestAsset& asset : manifest.value->assets) {
        for (const ManifestFile& file : asset.files) {
            if (is_cancelled(progress)) return {std::move(report), {}};
            check_file(report, place.folder, asset, file);
            bytes_left -= static_cast<double>(file.bytes);
            if (progress != nullptr) progress->advance("files", 1 - bytes_left / bytes);
        }
        check_further(report, asset, further);
    }
    for (const FolderCheck& check : of_folder) {
        for (VerifyFailure& failure : check(*manifest.value, place.folder, report.checks)) {
            report.failures.push_back(std::move(failure));
        }
    }
    return {std::move(report), std::move(manifest.diagnostics)};
}

}  // namespace skybake
