#include "bakers/io/manifest/journal.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/system_call.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestJournal = std::uintmax_t{1} << 30;

// How the text of a manifest ends. No line in it begins with a brace but this one.
constexpr std::string_view kEndOfText = "\n}\n";

std::vector<ManifestAsset> entries_of(const fs::path& journal) {
    const auto text = read_file(journal, kLargestJournal);
    std::vector<ManifestAsset> entries;
    std::string_view rest = text.value ? std::string_view(*text.value) : std::string_view();
    for (std::size_t end; (end = rest.find(kEndOfText)) != std::string_view::npos;) {
        end += kEndOfText.size();
        auto manifest = parse_manifest(rest.substr(0, end), journal.string());
        rest.remove_prefix(end);
        if (!manifest.value || !manifest.value->alterations.empty()) continue;
        for (ManifestAsset& asset : manifest.value->assets) entries.push_back(std::move(asset));
    }
    return entries;
}

bool has_all_files(const fs::path& folder, const ManifestAsset& entry) {
    return std::ranges::all_of(entry.files, [&](const ManifestFile& file) {
        return is_as_written(folder, {file.path, file.xxh3});
    });
}

// Returns whether the entry says anything new.
bool add_entry(const fs::path& folder, ManifestAsset entry, Manifest& manifest) {
    auto& known = manifest.assets;
    const auto same = std::ranges::find(known, entry.name, &ManifestAsset::name);
    if (same != known.end() && same->key == entry.key) return false;
    if (!has_all_files(folder, entry)) {
        for (const ManifestFile& file : entry.files) {
            const RetiredFile retired{file.path, file.xxh3};
            if (is_as_written(folder, retired)) manifest.retired.push_back(retired);
        }
    } else if (same == known.end()) {
        known.push_back(std::move(entry));
    } else {
        for (const ManifestFile& file : same->files) {
            manifest.retired.push_back({file.path, file.xxh3});
        }
        *same = std::move(entry);
    }
    return true;
}

// Returns errno, or 0.
int write_text_to(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count =
            uninterrupted([&] { return ::write(descriptor, text.data(), text.size()); });
        if (count <= 0) return count < 0 ? errno : EIO;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return flush_data(descriptor);
}

}  // namespace

std::vector<Diagnostic> BakeJournal::add(std::span<const ManifestAsset> entries) {
    if (entries.empty()) return {};
    Manifest manifest = new_manifest({});
    manifest.assets.assign(entries.begin(), entries.end());
    const fs::path file = folder_ / manifest_name;
    if (!file_) file_.emplace(file);
    if (file_->valid()) file_->leave_behind();
    const int error = file_->descriptor() >= 0
                          ? write_text_to(file_->descriptor(), manifest_json(manifest))
                          : errno;
    if (error == 0) return {};
    return {cannot_write(file, system_reason(error))};
}

void BakeJournal::discard() {
    if (file_ && file_->descriptor() >= 0) ::unlink(file_->path().c_str());
    file_.reset();
}

void BakeJournal::end() {
    discard();
    remove_stale_temporaries(folder_ / manifest_name);
}

bool add_journals(const fs::path& folder, std::optional<Manifest>& previous) {
    bool says_more = false;
    for (const fs::path& journal : temporaries_of(folder / manifest_name)) {
        for (ManifestAsset& entry : entries_of(journal)) {
            if (!previous) previous = new_manifest({});
            says_more = add_entry(folder, std::move(entry), *previous) || says_more;
        }
    }
    return says_more;
}

bool is_as_written(const fs::path& folder, const RetiredFile& file) {
    const fs::path path = file.path;
    std::error_code error;
    const bool plain = !path.has_parent_path() && path != manifest_name &&
                       fs::is_regular_file(fs::symlink_status(folder / path, error));
    if (!plain) return false;
    const auto print = fingerprint(folder / path);
    return print.value && print.value->xxh3 == file.xxh3;
}

}  // namespace skybake
