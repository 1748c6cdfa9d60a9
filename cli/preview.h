// This header describes what `preview` was asked for, writes its files, and watches files for
// --watch.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/page.h"
#include "bakers/render/sun_disc.h"
#include "bakers/render/tone_curve.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/cache_folder.h"
#include "cli/options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

namespace options {

// These report E0001 for a text that is not a number, has no unit or is out of range.
Outcome<std::vector<double>> read_elevations(const std::string& text);
Outcome<double> read_azimuth(const std::string& text);
Outcome<double> read_exposure(const std::string& text);
Outcome<double> read_altitude(const std::string& text);
Outcome<CameraRequest> read_camera(const std::string& text);
Outcome<std::array<int, 2>> read_size(const std::string& text);
Outcome<int> read_draft(const std::string& text);
Outcome<config::Moment> read_time(const std::string& text);
Outcome<EarthPlace> read_place(const std::string& text);
Outcome<int> read_turntable(const std::string& text);

inline const Option<std::vector<double>> sun_elevation{
    "sun-elevation", 0, "DEGREES", {}, read_elevations};
inline const Option<double> sun_azimuth{"sun-azimuth", 0, "DEGREES", {}, read_azimuth};
inline const Option<double> exposure{"exposure", 0, "STOPS", {}, read_exposure};
inline const Option<ToneCurve> tone_curve{"tone-curve",
                                          0,
                                          "CURVE",
                                          {{"film", ToneCurve::film},
                                           {"exponential", ToneCurve::exponential},
                                           {"aces", ToneCurve::aces},
                                           {"agx", ToneCurve::agx}}};
inline const Option<Glare> glare{
    "glare", 0, "KIND", {{"none", Glare::none}, {"camera", Glare::camera}, {"eye", Glare::eye}}};
inline const Option<double> altitude{"altitude", 0, "LENGTH", {}, read_altitude};  // in metres
inline const Option<CameraRequest> camera{"camera", 0, "PARTS", {}, read_camera};
inline const Option<std::array<int, 2>> size{"size", 0, "WxH", {}, read_size};
inline const Option<bool> single{"single"};
inline const Option<bool> table_sky{"table-sky"};
inline const Option<config::Moment> at{"at", 0, "TIME", {}, read_time};
inline const Option<EarthPlace> place{"place", 0, "LAT,LON", {}, read_place};
inline const Option<int> turntable{"turntable", 0, "N", {}, read_turntable};
inline const Option<bool> live{"live"};
inline const Option<bool> watch{"watch"};
inline const Option<int> draft{"draft", 0, "N", {}, read_draft};

}  // namespace options

// A live page shows no errors, so that nothing has to be certified for it.
inline Certification certification_of(const PreviewOptions& options) {
    return options.live ? Certification::off : Certification::quick;
}

struct PreviewRequest {
    enum class Subject { recipe, folder, sweep, files };
    Subject subject = Subject::recipe;
    std::vector<std::filesystem::path> paths;  // one path, or several files
    std::filesystem::path output;
    std::string page_path() const { return (output / page_name).string(); }
    bool force = false;
    bool watch = false;
    int draft_edge = 64;          // voxels along the longest edge of a draft's volumes
    std::filesystem::path cache;  // empty: none
    bool owns_cache = false;      // the cache is the program's own, which it keeps small
    PreviewOptions options;
};

// Files that were baked before, from which a preview takes what it need not bake: those in the folders
// that a bake of the recipe is likely to have written into, and those of the cache.
class ReadyFiles {
  public:
    explicit ReadyFiles(const PreviewRequest& request);
    ReadyFiles(const ReadyFiles&) = delete;
    ReadyFiles& operator=(const ReadyFiles&) = delete;
    // Removes what was used least recently from the program's own cache if that has grown beyond 256
    // MiB.
    ~ReadyFiles();

    // Return memos that use them: of the recipe's assets, and of the light of clouds.
    AssetMemo assets();
    AssetMemo light();
    KeptBytes* kept() { return &kept_; }

  private:
    const PreviewRequest& request_;
    BakedFolders folders_;
    std::optional<AssetCache> cache_;
    CachedBytes kept_;
};

// Reads what is asked for. A folder or a manifest.json is a folder; .exr, .vdb and .bin are files;
// anything else is a recipe. E0001 is reported for arguments that cannot go together, are not a
// number or are out of range.
Outcome<PreviewRequest> preview_request(const Invocation& invocation);

// Writes all files at once. Pictures of earlier previews that are not made any more stay where they
// are. Reports E0301, E0302 and E0303.
ExitCode write_preview(PreviewPage page, const PreviewRequest& request, Console& console);

// Makes a draft of the recipe's pictures and then the pictures at full quality. It does so again
// whenever the recipe, an include or a map changes, until it is interrupted. A change stops the
// work on the previous pictures. While the recipe has mistakes, its diagnostics are shown and the
// last good pictures stay. It returns early if the recipe is missing at the start or the folder
// cannot be written to.
ExitCode watch_preview(const Invocation& invocation, const PreviewRequest& request,
                       Console& console);

// Looks at files again and again to see when one of them changes.
class WatchedFiles {
  public:
    // Sets the files to look at from now on. They may be missing. Files that were followed before
    // count as changed if they changed after wait() returned; new files, if they change after this
    // call.
    void follow(const std::vector<std::filesystem::path>& paths);

    // Waits until a file was written, replaced, made or removed, and then until no file has changed
    // between two looks, because editors write in several steps. Returns true after a change and
    // false once interrupted. It looks files up by name, so that editors may rename a new file over
    // the old one. Each look costs one stat per file.
    bool wait();

    // Whether wait() would find a change at once. Any thread may call it while no other call is
    // running.
    bool changed() const { return look() != seen_; }

  private:
    static constexpr std::chrono::milliseconds look_every{25};
    // The text holds the time, size and identity of a file. Equal texts mean that the file is
    // untouched.
    using Signs = std::map<std::filesystem::path, std::string>;
    Signs look() const;

    Signs seen_;
};

}  // namespace skybake::cli
