// A cache of baked assets on a web server, which needs GET and PUT and nothing else.
//
//   URL/KEY.json   the manifest of one asset
//   URL/HASH       a file of any number of assets, by the XXH3 of its bytes
//
// A server costs time, never bytes. Files are held to their size and hash while they arrive. What
// is missing, cut off or damaged is baked and then put in its place. Each request has an end
// (Limits), and after a few failures the server is left alone for the rest of the run. Reading may take
// as long as baking took when the entries were made, which they say, and a few seconds more; then a
// server is slower than no cache, and is no longer read. The manifest is put last, so that whoever
// finds it finds its files.
//
// Hashes protect from accidents. Whoever may write to the server is trusted, as with a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/io/files/http.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/workspace/copy_asset.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Returns why a text cannot be the URL of a cache, or an empty text if it can.
std::string cache_url_problem(std::string_view url);

// Returns a URL without the user's name and password, for messages.
std::string without_credentials(std::string_view url);

// Any number of threads may use a cache at once.
class HttpCache : public AssetSource {
  public:
    struct Limits {
        double connect_s = 3;
        double silence_s = 5;              // the server sends or takes nothing for so long
        double start_s = 10;               // a request may last so long
        double bytes_per_s = 1024 * 1024;  // ... and the time of its bytes at this speed,
        double longest_s = 600;            // ... but no longer than this
        double uploads_s = 30;             // all uploads of a run, besides half of the run's time
        double reads_s = 5;                // all reading, besides what baking took the last time
        int failures = 3;                  // then the server is left alone
    };

    // The URL has no problem (cache_url_problem). Requests end once `cancelled` returns true.
    HttpCache(std::string url, std::function<bool()> cancelled, const Limits& limits);
    HttpCache(std::string url, std::function<bool()> cancelled)
        : HttpCache(std::move(url), std::move(cancelled), Limits()) {}

    std::optional<ReadyAsset> find(const std::string& key) override;
    Outcome<std::vector<WriteResult>> stage(const ReadyAsset& asset,
                                            const std::filesystem::path& folder, AtomicFiles& files,
                                            const Progress& progress) override;
    // Puts an asset that `find` was asked for and did not get.
    void offer(const ReadyAsset& asset) override;

    // Returns at most one warning, W0305, which says what went wrong in all requests so far.
    std::vector<Diagnostic> problems() const;

  private:
    HttpRequest request(const std::string& name, double bytes) const;
    HttpAnswer get(HttpRequest request);
    Outcome<bool> fetch(const ManifestFile& file, const std::filesystem::path& to);
    bool put(const std::string& name, std::uint64_t bytes,
             const std::function<std::optional<std::size_t>(char*, std::size_t)>& send);
    bool put_file(const std::filesystem::path& path, const ManifestFile& file);
    bool put_text(const std::string& name, const std::string& text);
    void fail(std::string_view method, const HttpAnswer& answer);
    void found_damage();
    bool may_read() const;
    bool may_write() const;
    double upload_seconds_left();
    double read_seconds_left() const;  // the mutex is locked
    bool is_cancelled() const { return cancelled_ && cancelled_(); }

    const std::string url_;  // without a slash at its end
    const std::function<bool()> cancelled_;
    const Limits limits_;
    const Stopwatch run_;

    mutable std::mutex mutex_;  // guards all members below
    std::set<std::string> missed_;
    int failures_ = 0;
    int damaged_ = 0;
    std::string first_failure_;
    double uploads_s_ = 0;
    bool uploads_ended_ = false;  // because of their time
    double reads_s_ = 0;
    double saved_s_ = 0;  // what baking took when the entries that are used were made
};

}  // namespace skybake
