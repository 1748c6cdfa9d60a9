#include "bakers/workspace/http_cache.h"

#include <fmt/format.h>

#include <algorithm>

#include "bakers/io/files/file_io.h"
#include "bakers/math/hash.h"
#include "bakers/workspace/asset_cache.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Manifests of one asset have up to some hundred KiB.
constexpr std::size_t largest_manifest = std::size_t{16} << 20;

std::string manifest_name_of(const std::string& key) { return key + ".json"; }

bool is_absent(const HttpAnswer& answer) {
    return answer.problem.empty() && (answer.status == 404 || answer.status == 410);
}

// Whether a PUT has succeeded: 200, 201 or 204.
bool is_kept(const HttpAnswer& answer) {
    return answer.problem.empty() && answer.status >= 200 && answer.status < 300;
}

// Returns how long an asset took to make.
double seconds_of(const Timing& timing) {
    const BakeSeconds& bake = timing.bake;
    return bake.light + bake.colors + bake.texels + bake.certificate + timing.write_s;
}

bool is_entry_with_safe_names(const Manifest& manifest, const std::string& key) {
    if (!is_entry_of(manifest, key)) return false;
    const auto& files = manifest.assets[0].files;
    return std::ranges::all_of(files, [](const ManifestFile& file) { return is_key(file.xxh3); });
}

}  // namespace

std::string cache_url_problem(std::string_view url) {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (!url.starts_with(scheme)) continue;
        const std::string_view rest = url.substr(scheme.size());
        const std::string_view host = rest.substr(0, rest.find('/'));
        if (host.empty() || host.back() == '@') return "the URL names no server";
        const bool plain = std::ranges::all_of(url, [](char c) {
            return c > ' ' && c < '\x7f' && c != '?' && c != '#' && c != '"' && c != '\\';
        });
        return plain ? "" : "it takes a URL without blanks, ? and #";
    }
    return "it takes http://HOST:PORT/PATH or https://HOST/PATH; --cache-dir takes a folder";
}

std::string without_credentials(std::string_view url) {
    const std::size_t scheme = url.find("://");
    const std::size_t begin = scheme == std::string_view::npos ? 0 : scheme + 3;
    const std::size_t at = url.rfind('@');
    if (at == std::string_view::npos || at < begin) return std::string(url);
    return std::string(url.substr(0, begin)) + std::string(url.substr(at + 1));
}

HttpCache::HttpCache(std::string url, std::function<bool()> cancelled, const Limits& limits)
    : url_(std::move(url.erase(url.find_last_not_of('/') + 1))),
      cancelled_(std::move(cancelled)),
      limits_(limits) {}

// --- Reading ------------------------------------------------------------------------------------

std::optional<ReadyAsset> HttpCache::find(const std::string& key) {
    if (!is_key(key) || !may_read()) return std::nullopt;
    const std::string name = manifest_name_of(key);
    std::string text;
    HttpRequest get = request(name, 0);
    get.receive = [&text](std::string_view piece) {
        text += piece;
        return text.size() <= largest_manifest;
    };
    const HttpAnswer answer = this->get(std::move(get));
    const bool arrived = answer.status == 200 && answer.problem.empty();
    if (!arrived && text.size() <= largest_manifest) {
        if (!is_absent(answer)) {
            fail("GET", answer);
            return std::nullopt;
        }
        const std::lock_guard lock(mutex_);
        missed_.insert(key);
        return std::nullopt;
    }
    const auto manifest = parse_manifest(text, name);
    if (arrived && manifest.value && is_entry_with_safe_names(*manifest.value, key)) {
        const std::lock_guard lock(mutex_);
        saved_s_ += seconds_of(manifest.value->assets[0].timing);
        return ReadyAsset{{}, manifest.value->assets[0]};
    }
    found_damage();
    const std::lock_guard lock(mutex_);
    missed_.insert(key);
    return std::nullopt;
}

Outcome<std::vector<WriteResult>> HttpCache::stage(const ReadyAsset& asset, const fs::path& folder,
                                                   AtomicFiles& files, const Progress& progress) {
    auto staged = stage_each(asset.entry, folder, files, progress,
                             [this](const ManifestFile& file, const fs::path& temporary) {
                                 return fetch(file, temporary);
                             });
    if (!staged.value) {
        const std::lock_guard lock(mutex_);
        saved_s_ -= seconds_of(asset.entry.timing);
        if (staged.diagnostics.front().code == "E0304") missed_.insert(asset.entry.key);
    }
    return staged;
}

// E0304 if the server has another file than the entry says or none, E0300 if the request fails,
// E0301 if the file cannot be written.
Outcome<bool> HttpCache::fetch(const ManifestFile& file, const fs::path& to) {
    const std::string name = url_ + '/' + file.xxh3;
    FileOutput output(to);
    Hasher hasher;
    std::uint64_t received = 0;
    HttpRequest get = request(file.xxh3, static_cast<double>(file.bytes));
    get.receive = [&](std::string_view piece) {
        received += piece.size();
        if (received > file.bytes) return false;
        hasher.update(piece);
        output.write(piece);
        return output.error() == 0;
    };
    const HttpAnswer answer = this->get(std::move(get));
    if (is_cancelled()) return {false, {}};
    if (!output.finish()) return output.diagnostic();
    const bool arrived = answer.status == 200 && answer.problem.empty();
    if (arrived && received == file.bytes && hasher.hex() == file.xxh3) return {true, {}};
    if (arrived || received > file.bytes || is_absent(answer)) {
        found_damage();
        return file_error("E0304", name, "the server does not have this file");
    }
    fail("GET", answer);
    return file_error("E0300", name, "the server does not send this file");
}

// Makes a request that reads. It ends with the time for reading, but a request of up to a second's bytes
// has its own end, so that a server that fails is told from one that is slow.
HttpAnswer HttpCache::get(HttpRequest request) {
    const double own_end_s = request.seconds;
    {
        const std::lock_guard lock(mutex_);
        const double least = limits_.start_s + 1;
        request.seconds = std::min(own_end_s, std::max(read_seconds_left(), least));
    }
    const Stopwatch stopwatch;
    const HttpAnswer answer = make_request(request);
    const double took_s = stopwatch.seconds();
    const bool is_cut_off = request.seconds < own_end_s && took_s >= request.seconds;
    const std::lock_guard lock(mutex_);
    if (answer.problem.empty() || is_cut_off) reads_s_ += took_s;
    return answer;
}

// --- Writing ------------------------------------------------------------------------------------

void HttpCache::offer(const ReadyAsset& asset) {
    {
        const std::lock_guard lock(mutex_);
        if (missed_.erase(asset.entry.key) == 0) return;
    }
    for (const ManifestFile& file : asset.entry.files) {
        if (!put_file(asset.folder / file.path, file)) return;
    }
    put_text(manifest_name_of(asset.entry.key), cached_manifest_json(asset.entry));
}

bool HttpCache::put_file(const fs::path& path, const ManifestFile& file) {
    auto input = FileInput::open(path);
    if (!input.value || input.value->size() != file.bytes) return false;  // changed since the bake
    std::uint64_t position = 0;
    return put(file.xxh3, file.bytes, [&](char* bytes, std::size_t count) {
        const auto sent = input.value->read(position, bytes, count);
        position += sent.value_or(0);
        return sent;
    });
}

bool HttpCache::put_text(const std::string& name, const std::string& text) {
    std::string_view rest = text;
    return put(name, text.size(), [&](char* bytes, std::size_t count) {
        const std::size_t sent = rest.copy(bytes, count);
        rest.remove_prefix(sent);
        return std::optional(sent);
    });
}

bool HttpCache::put(const std::string& name, std::uint64_t bytes,
                    const std::function<std::optional<std::size_t>(char*, std::size_t)>& send) {
    const double seconds_left = upload_seconds_left();
    if (!may_write() || seconds_left <= 0) return false;
    HttpRequest put = request(name, static_cast<double>(bytes));
    const bool is_shortened = seconds_left < put.seconds;
    put.seconds = std::min(put.seconds, seconds_left);
    put.upload_bytes = bytes;
    put.send = send;
    const Stopwatch stopwatch;
    const HttpAnswer answer = make_request(put);
    {
        const std::lock_guard lock(mutex_);
        uploads_s_ += stopwatch.seconds();
    }
    if (is_kept(answer)) return true;
    // A request that ends with the time of all uploads is no failure of its own.
    if (!is_shortened || upload_seconds_left() > 0) fail("PUT", answer);
    return false;
}

// --- Limits -------------------------------------------------------------------------------------

HttpRequest HttpCache::request(const std::string& name, double bytes) const {
    HttpRequest request;
    request.url = url_ + '/' + name;
    request.seconds = std::min(limits_.start_s + bytes / limits_.bytes_per_s, limits_.longest_s);
    request.silence_s = limits_.silence_s;
    request.connect_s = limits_.connect_s;
    request.cancelled = cancelled_;
    return request;
}

double HttpCache::upload_seconds_left() {
    const std::lock_guard lock(mutex_);
    const double left = limits_.uploads_s + 0.5 * run_.seconds() - uploads_s_;
    if (left <= 0) uploads_ended_ = true;
    return left;
}

// A server whose entries are wrong is no longer read, but it still gets what is right.
bool HttpCache::may_read() const {
    const std::lock_guard lock(mutex_);
    return failures_ < limits_.failures && damaged_ < limits_.failures && read_seconds_left() > 0 &&
           !is_cancelled();
}

double HttpCache::read_seconds_left() const { return limits_.reads_s + saved_s_ - reads_s_; }

bool HttpCache::may_write() const {
    const std::lock_guard lock(mutex_);
    return failures_ < limits_.failures && !is_cancelled();
}

void HttpCache::fail(std::string_view method, const HttpAnswer& answer) {
    if (is_cancelled()) return;
    const std::lock_guard lock(mutex_);
    // A request that ends with the time of all reading is no failure of its own.
    if (method == "GET" && read_seconds_left() <= 0) return;
    if (failures_++ > 0) return;
    first_failure_ = answer.problem.empty()
                         ? fmt::format("{} was answered by status {}", method, answer.status)
                         : fmt::format("{}: {}", method, answer.problem);
}

void HttpCache::found_damage() {
    const std::lock_guard lock(mutex_);
    ++damaged_;
}

std::vector<Diagnostic> HttpCache::problems() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> sentences;
    const auto times = [](int count) {
        return count == 1 ? "once" : fmt::format("{} times", count);
    };
    if (failures_ > 0) {
        sentences.push_back(fmt::format(
            "it failed {}{}, first with `{}`", times(failures_),
            failures_ < limits_.failures ? "" : " and was then left alone", first_failure_));
    }
    if (damaged_ > 0) {
        sentences.push_back(fmt::format("{} of its entries {} damaged and not used", damaged_,
                                        damaged_ == 1 ? "was" : "were"));
    }
    if (read_seconds_left() <= 0) {
        sentences.push_back("it was no longer read, because reading took longer than baking does");
    }
    if (uploads_ended_) sentences.push_back("it did not get all assets, because it is slow");
    if (sentences.empty()) return {};
    const std::string name = without_credentials(url_);
    return {
        diagnosis("W0305", fmt::format("the cache `{}`: {}", name, fmt::join(sentences, "; ")))};
}

}  // namespace skybake
