// What `preview` was asked for, its files, and the watch of --watch.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/page.h"
#include "cli/options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

namespace options {

// E0001 for what is no number, has no unit or is out of range.
config::Outcome<std::vector<double>> read_elevations(const std::string& text);
config::Outcome<double> read_azimuth(const std::string& text);
config::Outcome<double> read_exposure(const std::string& text);
config::Outcome<double> read_altitude(const std::string& text);
config::Outcome<CameraRequest> read_camera(const std::string& text);
config::Outcome<std::array<int, 2>> read_size(const std::string& text);
config::Outcome<int> read_draft(const std::string& text);

inline const Option<std::vector<double>> sun_elevation{
    "sun-elevation", 0, "DEGREES", {}, read_elevations};
inline const Option<double> sun_azimuth{"sun-azimuth", 0, "DEGREES", {}, read_azimuth};
inline const Option<double> exposure{"exposure", 0, "STOPS", {}, read_exposure};
inline const Option<double> altitude{"altitude", 0, "LENGTH", {}, read_altitude};  // in metres
inline const Option<CameraRequest> camera{"camera", 0, "PARTS", {}, read_camera};
inline const Option<std::array<int, 2>> size{"size", 0, "WxH", {}, read_size};
inline const Option<bool> single{"single"};
inline const Option<bool> report{"report"};
inline const Option<bool> watch{"watch"};
inline const Option<int> draft{"draft", 0, "N", {}, read_draft};

}  // namespace options

struct PreviewRequest {
    enum class Subject { recipe, folder, sweep, files };
    Subject subject = Subject::recipe;
    std::vector<std::filesystem::path> paths;  // one, but of files
    std::filesystem::path output;
    bool force = false;
    bool report = false;
    bool watch = false;
    int draft_edge = 64;  // voxels along the longest edge of a draft's volumes
    PreviewOptions options;
};

// A folder or a manifest.json is a folder; .exr, .vdb and .bin are files; anything else is a
// recipe. E0001: what cannot go together, what is no number or out of range.
config::Outcome<PreviewRequest> preview_request(const Invocation& invocation);

// Whether the folder may be written to, as far as one sees before the pictures are made: reported
// where not. E0302, E0303.
ExitCode check_output(const PreviewRequest& request, Console& console);

// Writes all files at once, and says which in `paths`, the page last. Pictures of earlier previews
// that are not made any more stay where they are. E0301, E0302, E0303.
ExitCode write_preview(PreviewPage page, const PreviewRequest& request, Console& console,
                       std::vector<std::string>& paths);

// Makes a draft of the recipe's pictures and then the pictures at full quality, and again whenever
// the recipe, an include or a map changes, until interrupted; a change ends what is being made.
// While the recipe has mistakes its diagnostics are shown and the last good pictures stay. Returns
// early where the recipe is missing at the start or the folder cannot be written to.
ExitCode watch_preview(const Invocation& invocation, const PreviewRequest& request,
                       Console& console);

// Files that are looked at again and again, to see when one of them changes.
class WatchedFiles {
  public:
    // The files to look at from now on; they may be missing. Those that were among the ones before
    // have changed if they did since wait() returned, new ones if they do after this call.
    void follow(const std::vector<std::filesystem::path>& paths);

    // Waits until a file was written, replaced, made or removed, and then until all have been at
    // rest for one look (editors write in several goes). True after a change, false once
    // interrupted. Looks by name, so that editors may rename a new file over the old one, at the
    // cost of one stat per file and look.
    bool wait();

    // Whether wait() would find a change at once. From any thread, while no other call is under
    // way.
    bool changed() const { return look() != seen_; }

  private:
    static constexpr std::chrono::milliseconds look_every{25};
    // Time, size and identity of a file; equal texts, untouched file.
    using Signs = std::map<std::filesystem::path, std::string>;
    Signs look() const;

    Signs seen_;
};

}  // namespace skybake::cli
