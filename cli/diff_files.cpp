#include "cli/diff_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/volumes/grid_files.h"
#include "bakers/preview/load_sweep.h"
#include "cli/command.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

void append(const std::vector<Diagnostic>& from, std::vector<Diagnostic>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

// Adds what was found of two files, which a name tells apart from others.
void add(const std::string& name, Outcome<ImageDifference> difference, Comparison& comparison) {
    append(difference.diagnostics, comparison.diagnostics);
    if (difference.value) comparison.files.push_back({name, "", std::move(*difference.value)});
}

void add_layout(const std::string& name, std::string layout, Comparison& comparison) {
    comparison.files.push_back({name, "", {std::move(layout), {}, {}}});
}

// Compares two images, which have been opened.
template <class Image, class Compared>
void compare_opened(Outcome<Image> first, Outcome<Image> second, const Compared& compared,
                    const std::string& name, Comparison& comparison) {
    append(first.diagnostics, comparison.diagnostics);
    append(second.diagnostics, comparison.diagnostics);
    if (!first.value || !second.value) return;
    add(name, skybake::compare_images(compared(*first.value), compared(*second.value)), comparison);
}

void compare_images(const fs::path& first, const fs::path& second, const std::string& name,
                    Comparison& comparison) {
    const auto parts = read_exr_heads(first);
    const auto others = read_exr_heads(second);
    const std::size_t count = parts.value ? parts.value->size() : 1;
    if (others.value && parts.value && others.value->size() != count) {
        return add_layout(name, fmt::format("{} parts against {}", count, others.value->size()),
                          comparison);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_one = count == 1;
        const auto part = static_cast<int>(i);
        compare_opened(
            ExrRows::open(first, part), ExrRows::open(second, part),
            [](ExrRows& file) { return compared(file); },
            is_one ? name : fmt::format("{}, part {}", name, (*parts.value)[i].name), comparison);
    }
}

bool is_radiance(const fs::path& path) { return path.extension() == ".hdr"; }

// Compares the levels that both files have.
void compare_levels(const ListedFile& first, const ListedFile& second, const std::string& name,
                    Comparison& comparison) {
    if (first.file.levels != second.file.levels) {
        return add_layout(
            name, fmt::format("{} levels against {}", first.file.levels, second.file.levels),
            comparison);
    }
    for (int level = 0; level < first.file.levels; ++level) {
        auto difference = compare_listed(first, second, level);
        const bool goes_on = difference.value.has_value();
        add(first.file.levels == 1 ? name : fmt::format("{}, level {}", name, level),
            std::move(difference), comparison);
        if (!goes_on) return;
    }
}

// Compares files by their values if the manifests beside both list them, and says whether they do.
bool compare_if_listed(const fs::path& first, const fs::path& second, const std::string& name,
                       Comparison& comparison) {
    const auto one = listed_file(first);
    const auto other = one ? listed_file(second) : std::nullopt;
    if (other) compare_levels(*one, *other, name, comparison);
    return other.has_value();
}

// Compares files by their bytes. If these differ, those with grids, Radiance pictures and files that their
// manifests list are compared by their values.
void compare_bytes(const fs::path& first, const fs::path& second, const std::string& name,
                   Comparison& comparison) {
    const auto a = fingerprint(first);
    const auto b = fingerprint(second);
    append(a.diagnostics, comparison.diagnostics);
    append(b.diagnostics, comparison.diagnostics);
    if (!a.value || !b.value) return;
    if (a.value->bytes == b.value->bytes && a.value->xxh3 == b.value->xxh3) {
        return add_layout(name, "", comparison);
    }
    if (is_radiance(first) && is_radiance(second)) {
        return compare_opened(
            compared_radiance(first), compared_radiance(second),
            [](const ComparedImage& image) { return image; }, name, comparison);
    }
    if (has_grids(first) && has_grids(second)) {
        return add(name, compare_volumes(first, second), comparison);
    }
    if (compare_if_listed(first, second, name, comparison)) return;
    add_layout(name,
               a.value->bytes != b.value->bytes
                   ? fmt::format("{} bytes against {}", a.value->bytes, b.value->bytes)
                   : "the bytes differ; only values of EXR, VDB, NanoVDB and HDR files are "
                     "compared without a manifest that lists them",
               comparison);
}

bool is_image(const fs::path& path) { return path.extension() == ".exr"; }

// Whether the file is a volume in a format other than EXR, or a file that stands beside a volume.
// The manifest does not count: it says how each file was made and how long that took.
bool is_other_volume(const fs::path& path) {
    if (path.extension() == ".json") return path.filename() != "manifest.json";
    return !is_image(path) && path.has_extension() &&
           find_format(path.extension().string().substr(1)) != nullptr;
}

void compare_files(const fs::path& first, const fs::path& second, const std::string& name,
                   Comparison& comparison) {
    if (is_other_volume(first) && is_other_volume(second)) {
        return compare_bytes(first, second, name, comparison);
    }
    const bool is_one_image = is_image(first) != is_image(second);
    if (is_one_image && compare_if_listed(first, second, name, comparison)) return;
    compare_images(first, second, name, comparison);
}

// Returns the names of a folder's files; those of a sweep's variants begin with their folders.
std::set<std::string> files_in(const fs::path& folder, std::vector<Diagnostic>& diagnostics) {
    std::set<std::string> names;
    std::error_code error;
    const bool has_variants = is_sweep_folder(folder);
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (!has_variants) entry.disable_recursion_pending();
        if (is_image(entry->path()) || is_other_volume(entry->path())) {
            names.insert(entry->path().lexically_relative(folder).string());
        }
    }
    if (error || names.empty()) {
        diagnostics.push_back(file_error(
            "E0300", folder.string(),
            fmt::format("cannot compare `{}`: {}", folder.string(),
                        error ? error.message() : "it holds no .exr, .vdb or .bin file")));
    }
    return names;
}

// Returns the bytes of those files of a folder that are there.
double bytes_of(const fs::path& folder, const std::set<std::string>& names) {
    double bytes = 0;
    for (const std::string& name : names) {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(folder / name, error);
        if (!error) bytes += static_cast<double>(size);
    }
    return bytes;
}

void compare_folders(const fs::path& first, const fs::path& second, Progress& progress,
                     Comparison& comparison) {
    const auto in_first = files_in(first, comparison.diagnostics);
    const auto in_second = files_in(second, comparison.diagnostics);
    if (!comparison.diagnostics.empty()) return;
    std::set<std::string> names = in_first;
    names.insert(in_second.begin(), in_second.end());
    double bytes_left = bytes_of(second, in_second);
    const double bytes = std::max(bytes_left, 1.0);
    for (const std::string& name : names) {
        if (progress.cancelled()) return;
        progress.advance("files", 1 - bytes_left / bytes);
        bytes_left -= bytes_of(second, {name});
        if (in_first.count(name) == 0) {
            comparison.files.push_back({name, second.string(), {}});
        } else if (in_second.count(name) == 0) {
            comparison.files.push_back({name, first.string(), {}});
        } else {
            compare_files(first / name, second / name, name, comparison);
        }
    }
}

}  // namespace

Comparison compare(const fs::path& first, const fs::path& second, Progress& progress) {
    Comparison comparison;
    std::error_code error;
    const bool folders = fs::is_directory(first, error);
    if (folders != fs::is_directory(second, error) && fs::exists(first, error) &&
        fs::exists(second, error)) {
        comparison.diagnostics.push_back(usage_error("a file cannot be compared with a folder"));
    } else if (folders) {
        compare_folders(first, second, progress, comparison);
    } else {
        compare_files(first, second, second.filename().string(), comparison);
    }
    return comparison;
}

}  // namespace skybake::cli
