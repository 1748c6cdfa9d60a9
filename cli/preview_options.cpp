#include "cli/preview_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "cli/bake_selection.h"
#include "cli/parse_arguments.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake::cli {
namespace {

using config::Diagnostic;
using config::Dimension;

// A number, or a quantity of that dimension, in base units.
std::optional<double> value_of(std::string_view text, Dimension dimension) {
    const auto parsed = config::parse_quantity(text);
    const auto* quantity = std::get_if<config::Quantity>(&parsed);
    if (quantity == nullptr || quantity->dimension != dimension) return std::nullopt;
    return quantity->value;
}

// "20" and "20 deg" alike, within these bounds.
std::optional<double> degrees_of(std::string_view text, double lowest, double highest) {
    std::optional<double> degrees = value_of(text, Dimension::number);
    if (!degrees) {
        const auto radians = value_of(text, Dimension::angle);
        if (radians) degrees = *radians * 180 / std::numbers::pi;
    }
    if (!degrees || *degrees < lowest || *degrees > highest) return std::nullopt;
    return degrees;
}

Diagnostic bad_value(std::string_view option, std::string_view text, std::string_view what,
                     std::string label) {
    return usage_error(
        fmt::format("{}: `{}` is not a valid {}", option, config::printable(text), what),
        std::move(label));
}

// What stands between commas; empty pieces too.
std::vector<std::string_view> pieces_of(std::string_view list) {
    std::vector<std::string_view> pieces;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t comma = std::min(list.find(',', at), list.size());
        pieces.push_back(list.substr(at, comma - at));
        at = comma + 1;
    }
    return pieces;
}

// Each value may hold several, with commas between.
void read_elevations(const Invocation& invocation, PreviewOptions& options,
                     std::vector<Diagnostic>& problems) {
    for (const std::string& list : invocation.values("sun-elevation")) {
        for (const std::string_view text : pieces_of(list)) {
            if (const auto elevation = degrees_of(text, -90, 90)) {
                options.sun_elevations_deg.push_back(*elevation);
            } else {
                problems.push_back(bad_value("--sun-elevation", text, "sun elevation",
                                             "expected degrees from -90 to 90, such as 40,5,-4"));
            }
        }
    }
}

void read_azimuth(const Invocation& invocation, PreviewOptions& options,
                  std::vector<Diagnostic>& problems) {
    if (!invocation.has("sun-azimuth")) return;
    const std::string text = invocation.value("sun-azimuth");
    options.sun_azimuth_deg = degrees_of(text, -360, 360);
    if (options.sun_azimuth_deg) return;
    problems.push_back(bad_value("--sun-azimuth", text, "sun azimuth",
                                 "expected degrees from -360 to 360, such as 150"));
}

void read_exposure(const Invocation& invocation, PreviewOptions& options,
                   std::vector<Diagnostic>& problems) {
    if (!invocation.has("exposure")) return;
    const std::string text = invocation.value("exposure");
    const auto stops = value_of(text, Dimension::number);
    constexpr double most_stops = 32;  // beyond, every pixel is black or white
    if (stops && *stops >= -most_stops && *stops <= most_stops) {
        options.exposure_stops = *stops;
    } else {
        problems.push_back(bad_value("--exposure", text, "exposure",
                                     "expected stops from -32 to 32, such as 4 or -1.5"));
    }
}

void read_altitude(const Invocation& invocation, PreviewOptions& options,
                   std::vector<Diagnostic>& problems) {
    if (!invocation.has("altitude")) return;
    const std::string text = invocation.value("altitude");
    const auto meters = value_of(text, Dimension::length);
    if (meters && *meters >= 0) {
        options.altitude_m = *meters;
    } else {
        problems.push_back(bad_value("--altitude", text, "altitude",
                                     "expected a length of at least 0, such as 2km"));
    }
}

// A count without sign or spaces.
std::optional<int> count_of(std::string_view text, int least, int most) {
    if (text.empty() || text.size() > 6) return std::nullopt;
    int value = 0;
    for (const char c : text) {
        if (c < '0' || c > '9') return std::nullopt;
        value = 10 * value + (c - '0');
    }
    if (value < least || value > most) return std::nullopt;
    return value;
}

void read_size(const Invocation& invocation, PreviewOptions& options,
               std::vector<Diagnostic>& problems) {
    if (!invocation.has("size")) return;
    constexpr int least = 16;
    constexpr int most = 8192;
    const std::string text = invocation.value("size");
    const std::size_t by = std::min(text.find('x'), text.size());
    const auto width = count_of(std::string_view(text).substr(0, by), least, most);
    const auto height =
        count_of(std::string_view(text).substr(std::min(by + 1, text.size())), least, most);
    if (width && height) {
        options.picture_size = {*width, *height};
    } else {
        problems.push_back(bad_value(
            "--size", text, "size",
            fmt::format("expected pixels from {} to {}, such as 1920x1080", least, most)));
    }
}

std::optional<std::array<double, 3>> position_of(std::string_view text) {
    const auto pieces = pieces_of(text);
    if (pieces.size() != 3) return std::nullopt;
    std::array<double, 3> position{};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto meters = value_of(pieces[a], Dimension::length);
        if (!meters) return std::nullopt;
        position[a] = *meters;
    }
    if (position[2] < 0) return std::nullopt;
    return position;
}

// One part of a camera, "pitch=12deg". False where it is none.
bool read_camera_part(std::string_view name, std::string_view value, CameraRequest& camera) {
    if (name == "position") {
        camera.position_m = position_of(value);
        return camera.position_m.has_value();
    }
    std::optional<double>* const part = name == "heading" ? &camera.heading_degrees
                                        : name == "pitch" ? &camera.pitch_degrees
                                        : name == "fov"   ? &camera.field_degrees
                                                          : nullptr;
    if (part == nullptr) return false;
    const double bound = name == "heading" ? 360 : name == "pitch" ? 90 : 160;
    *part = degrees_of(value, name == "fov" ? 1 : -bound, bound);
    return part->has_value();
}

void read_camera(const Invocation& invocation, PreviewOptions& options,
                 std::vector<Diagnostic>& problems) {
    if (!invocation.has("camera")) return;
    const std::string text = invocation.value("camera");
    CameraRequest camera;
    if (text.find_first_not_of(' ') == std::string::npos) {
        problems.push_back(usage_error("--camera: the text is empty"));
    }
    for (std::size_t at = text.find_first_not_of(' '); at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string_view part = std::string_view(text).substr(at, end - at);
        at = std::min(text.find_first_not_of(' ', end), text.size());
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string_view value = part.substr(std::min(equals + 1, part.size()));
        if (read_camera_part(part.substr(0, equals), value, camera)) continue;
        problems.push_back(
            bad_value("--camera", part, "part of a camera",
                      "expected some of position=X,Y,Z heading=A pitch=A fov=A, such as "
                      "\"position=2km,3km,200m heading=63deg pitch=12deg fov=50deg\""));
    }
    options.camera = camera;
}

}  // namespace

std::vector<Option> preview_options() {
    return {
        {.name = "output",
         .short_name = 'o',
         .value = "FOLDER",
         .help = "write index.html and its pictures into this folder",
         .fallback = "preview"},
        set_option(),
        only_option("show only [bake.NAME]"),
        {.name = "sun-elevation",
         .value = "DEGREES",
         .help = "show skies and clouds under these suns; separate them by commas",
         .repeatable = true},
        {.name = "sun-azimuth",
         .value = "DEGREES",
         .help = "place the sun of clouds, from +x towards +y (default 105)"},
        {.name = "exposure",
         .value = "STOPS",
         .help = "fix the exposure; 0 stops is a factor of 1 (default: chosen)"},
        {.name = "altitude",
         .value = "LENGTH",
         .help = "place the camera of skies at this altitude (default 200m)"},
        {.name = "camera",
         .value = "PARTS",
         .help = "place the camera of clouds by \"position=2km,3km,200m heading=63deg pitch=12deg "
                 "fov=50deg\" or some of these; the heading turns from +x towards +y"},
        {.name = "size",
         .value = "WxH",
         .help = "make pictures of clouds this large (default 960x540)"},
        {.name = "single", .help = "show a single tile of a cloud, framed as a whole"},
        {.name = "report", .help = "also measure and plot speed against error"},
        {.name = "watch",
         .help = "follow the recipe until Ctrl-C, with a draft and then full quality"},
        {.name = "draft",
         .value = "N",
         .help = "give a draft's volumes N voxels along the longest edge (default 64)"},
        jobs_option("use N threads; pictures do not depend on N (default: all)"),
        {.name = "force", .help = "overwrite files that no preview has made"}};
}

PreviewOptions read_preview_options(const Invocation& invocation,
                                    std::vector<Diagnostic>& problems) {
    PreviewOptions options;
    read_elevations(invocation, options, problems);
    read_azimuth(invocation, options, problems);
    read_exposure(invocation, options, problems);
    read_altitude(invocation, options, problems);
    read_camera(invocation, options, problems);
    read_size(invocation, options, problems);
    options.single = invocation.has("single");
    return options;
}

std::optional<int> read_draft_edge(const Invocation& invocation,
                                   std::vector<Diagnostic>& problems) {
    if (!invocation.has("draft")) return std::nullopt;
    constexpr int least = 16;
    constexpr int most = 1024;
    const std::string text = invocation.value("draft");
    const auto edge = count_of(text, least, most);
    if (!edge) {
        problems.push_back(bad_value("--draft", text, "number of voxels",
                                     fmt::format("expected a number from {} to {}", least, most)));
    }
    return edge;
}

}  // namespace skybake::cli
