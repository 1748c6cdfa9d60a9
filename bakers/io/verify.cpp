#include "bakers/io/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <utility>

#include "bakers/core/bilinear.h"
#include "bakers/io/hash.h"
#include "bakers/io/metadata.h"
#include "bakers/io/read_file.h"
#include "bakers/io/spelling.h"

namespace skybake {
namespace {

// Counts checks and keeps the failed ones of one file.
class Examination {
  public:
    Examination(VerifyReport& report, std::string file) : report_(report), file_(std::move(file)) {}

    void fail(std::string check, std::string message) {
        report_.failures.push_back({file_, std::move(check), std::move(message)});
    }
    bool expect(bool holds, const char* check, const std::string& message) {
        ++report_.checks;
        if (!holds) fail(check, message);
        return holds;
    }
    template <class T>
    void expect_equal(const T& found, const T& wanted, const char* check, std::string_view what) {
        expect(found == wanted, check,
               fmt::format("{} is {}, the manifest says {}", what, found, wanted));
    }
    void count(int checks) { report_.checks += checks; }

  private:
    VerifyReport& report_;
    std::string file_;
};

// Long texts (the parameters) are not shown whole: the first line that differs says more.
std::string first_difference(const std::string& found, const std::string& wanted) {
    std::size_t begin = 0;
    std::size_t i = 0;
    while (i < found.size() && i < wanted.size() && found[i] == wanted[i]) {
        if (found[i++] == '\n') begin = i;
    }
    const auto line = [begin](const std::string& text) {
        return text.substr(std::min(begin, text.size()), text.find('\n', begin) - begin);
    };
    return fmt::format("`{}`, the manifest says `{}`", line(found), line(wanted));
}

void check_attributes(Examination& examination, const ManifestAsset& asset, const ExrImage& image) {
    std::map<std::string, std::string> found(image.attributes.begin(), image.attributes.end());
    for (const auto& [name, wanted] : exr_attributes(asset)) {
        const auto entry = found.find(name);
        if (entry == found.end()) {
            examination.expect(false, "metadata", fmt::format("the attribute {} is missing", name));
            continue;
        }
        examination.expect(entry->second == wanted, "metadata",
                           fmt::format("{} is {}", name, first_difference(entry->second, wanted)));
    }
}

void check_texels(Examination& examination, const ManifestAsset& asset, const ManifestFile& file,
                  const ExrImage& image) {
    long not_finite = 0;
    for (const float value : image.pixels.texels) not_finite += std::isfinite(value) ? 0 : 1;
    examination.expect(not_finite == 0, "finite",
                       fmt::format("{} values are NaN or infinite", not_finite));
    examination.expect_equal(xxh3_hex(stored_bytes(image.pixels, file.pixel_type)),
                             asset.content_hash, "content_hash", "the hash of the texels");
}

std::string place_of(const Probe& probe) {
    std::string place;
    for (const auto& [quantity, value] : probe.at) {
        place += fmt::format("{}{} {}", place.empty() ? "" : ", ", quantity, value);
    }
    return place;
}

void check_probe(Examination& examination, const Probe& probe, const Image2<float>& pixels) {
    const auto [u, v] = probe.uv;
    const bool inside = u >= 0 && u <= 1 && v >= 0 && v <= 1;
    const std::string place = place_of(probe);
    if (!examination.expect(inside, "probe",
                            fmt::format("uv ({}, {}) of {} is outside of [0, 1]", u, v, place))) {
        return;
    }
    std::vector<double> found(static_cast<std::size_t>(pixels.channels));
    bilinear(pixels, u, v, found.data());
    if (!examination.expect(
            probe.value.size() == found.size() && probe.tolerance.size() == found.size(), "probe",
            fmt::format("the probe at {} does not have {} channels", place, found.size()))) {
        return;
    }
    bool holds = true;
    for (std::size_t i = 0; i < found.size(); ++i) {
        holds = holds && std::abs(found[i] - probe.value[i]) <= probe.tolerance[i];
    }
    examination.expect(holds, "probe",
                       fmt::format("at {} the file gives ({}), the manifest says ({}) ± ({})",
                                   place, fmt::join(found, ", "), fmt::join(probe.value, ", "),
                                   fmt::join(probe.tolerance, ", ")));
}

void check_image(Examination& examination, const ManifestAsset& asset, const ManifestFile& file,
                 const ExrImage& image) {
    const std::array<int, 2> size = {image.pixels.width, image.pixels.height};
    examination.expect_equal(size, asset.size, "size", "the size");
    examination.expect_equal(image.channel_names, asset.channels, "channels",
                             "the list of channels");
    examination.expect_equal(spell(image.pixel_type), spell(file.pixel_type), "pixel_type",
                             "the pixel type");
    examination.expect_equal(spell(image.compression), spell(asset.compression), "compression",
                             "the compression");
    check_attributes(examination, asset, image);
    check_texels(examination, asset, file, image);
    for (const Probe& probe : asset.probes) check_probe(examination, probe, image.pixels);
}

void check_file(VerifyReport& report, const std::filesystem::path& folder,
                const ManifestAsset& asset, const ManifestFile& file,
                std::span<const AssetCheck> further) {
    ++report.files;
    Examination examination(report, file.path);
    const config::Outcome<std::string> bytes = read_file(folder / file.path);
    if (!examination.expect(bytes.value.has_value(), "file",
                            bytes.value ? "" : bytes.diagnostics[0].message)) {
        return;
    }
    examination.expect_equal(std::uint64_t{bytes.value->size()}, file.bytes, "bytes",
                             "the number of bytes");
    examination.expect_equal(xxh3_hex(*bytes.value), file.xxh3, "xxh3", "the hash of the file");

    const config::Outcome<ExrImage> image = decode_exr(*bytes.value, file.path);
    if (!examination.expect(image.value.has_value(), "format",
                            image.value ? "" : image.diagnostics[0].message)) {
        return;
    }
    check_image(examination, asset, file, *image.value);
    for (const AssetCheck& check : further) {
        int checks = 0;
        for (std::string& message : check.run(asset, *image.value, checks)) {
            examination.fail(check.name, std::move(message));
        }
        examination.count(checks);
    }
}

}  // namespace

config::Outcome<VerifyReport> verify_folder(const std::filesystem::path& folder,
                                            std::span<const AssetCheck> further) {
    config::Outcome<Manifest> manifest = read_manifest(folder);
    if (!manifest.value) return {{}, std::move(manifest.diagnostics)};
    VerifyReport report;
    for (const ManifestAsset& asset : manifest.value->assets) {
        for (const ManifestFile& file : asset.files)
            check_file(report, folder, asset, file, further);
    }
    return {std::move(report), std::move(manifest.diagnostics)};
}

}  // namespace skybake
