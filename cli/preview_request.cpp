#include "cli/preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/preview/load_sweep.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/volume_recipe.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Dimension;
using Subject = PreviewRequest::Subject;

// Reads a number, or a quantity of that dimension in base units.
std::optional<double> value_of(std::string_view text, Dimension dimension) {
    const auto parsed = config::parse_quantity(text);
    const auto* quantity = std::get_if<config::Quantity>(&parsed);
    if (quantity == nullptr || quantity->dimension != dimension) return std::nullopt;
    return quantity->value;
}

// Reads "20" and "20 deg" as the same angle, in degrees within these bounds.
std::optional<double> degrees_of(std::string_view text, double lowest, double highest) {
    std::optional<double> degrees = value_of(text, Dimension::number);
    if (!degrees) {
        const auto radians = value_of(text, Dimension::angle);
        if (radians) degrees = *radians * 180 / std::numbers::pi;
    }
    if (!degrees || *degrees < lowest || *degrees > highest) return std::nullopt;
    return degrees;
}

Diagnostic not_valid(std::string_view option, std::string_view text, std::string_view what,
                     std::string label) {
    return usage_error(
        fmt::format("{}: `{}` is not a valid {}", option, config::printable(text), what),
        std::move(label));
}

// Returns the value of an option, or E0001 if its text has none.
template <class T>
Outcome<T> valid(const std::optional<T>& value, std::string_view option, std::string_view text,
                 std::string_view what, std::string label) {
    if (value) return {value, {}};
    return not_valid(option, text, what, std::move(label));
}

Outcome<int> read_count(std::string_view text, int least, int most, std::string_view option,
                        std::string_view what) {
    return valid(parse_count(text, least, most), option, text, what,
                 fmt::format("expected a number from {} to {}", least, most));
}

std::optional<std::array<double, 3>> position_of(std::string_view text) {
    const auto pieces = config::pieces_between(text, ',');
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

// Reads one part of a camera, such as "pitch=12deg". Returns false if it is not one.
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

// --- The request --------------------------------------------------------------------------------

Subject subject_of(const fs::path& path) {
    std::error_code error;
    if (is_sweep_folder(path)) return Subject::sweep;
    if (is_foreign_volume(path.string())) return Subject::recipe;
    if (fs::is_directory(path, error) || path.filename() == manifest_name) return Subject::folder;
    const std::string extension = path.extension().string();
    const bool baked = extension.size() > 1 && find_format(extension.substr(1)) != nullptr;
    return baked ? Subject::files : Subject::recipe;
}

// Reports options that a live page has no use for.
void check_live(const Invocation& invocation, const PreviewRequest& request,
                std::vector<Diagnostic>& problems) {
    if (!invocation[options::live]) return;
    if (request.subject == Subject::sweep) {
        problems.push_back(usage_error("--live does not work with a sweep",
                                       "each of its variants is a folder: show one of those"));
    }
    const auto refuse = [&](const auto& option, const char* why) {
        if (!invocation.has(option)) return;
        problems.push_back(
            usage_error(fmt::format("--live and --{} exclude each other", option.name), why));
    };
    refuse(options::turntable, "a live page turns as you look around in it");
    refuse(options::size, "the picture of a live page is as large as the browser's window");
    refuse(options::glare, "a live page has a switch for it");
}

// Reports options that only recipes have, if baked files are given, and other options that
// contradict each other.
void check_combination(const Invocation& invocation, const PreviewRequest& request,
                       std::vector<Diagnostic>& problems) {
    if (request.paths.size() > 1 && request.subject != Subject::files) {
        problems.push_back(usage_error("preview takes one recipe or one folder at a time",
                                       "it takes several files: a.exr b.exr"));
    }
    if (request.watch && is_standard_input(request.paths[0].string())) {
        problems.push_back(usage_error("--watch needs a recipe in a file",
                                       "standard input cannot be read a second time"));
    }
    if (request.subject == Subject::sweep && invocation.has(options::turntable)) {
        problems.push_back(
            usage_error("--turntable does not work with a sweep",
                        "each of its variants is a folder: preview one of those with --turntable"));
    }
    check_live(invocation, request, problems);
    if (request.subject == Subject::recipe) return;
    const std::string baked = config::printable(request.paths[0].string());
    const auto refuse = [&](const auto& option, std::string_view instead) {
        if (!invocation.has(option)) return;
        problems.push_back(usage_error(fmt::format("--{} works only with a recipe", option.name),
                                       fmt::format("`{}` is baked already{}", baked, instead)));
    };
    refuse(options::set, "");
    refuse(options::only, "; preview the files of those assets instead");
    refuse(options::watch, "");
}

// Returns the options for pictures: suns, exposure, camera and size.
PreviewOptions picture_options(const Invocation& invocation) {
    return {.sun_elevations_deg = invocation[options::sun_elevation],
            .exposure_stops = invocation.given(options::exposure),
            .tone_curve = invocation.given(options::tone_curve),
            .glare = invocation.given(options::glare),
            .altitude_m = invocation.given(options::altitude),
            .sun_azimuth_deg = invocation.given(options::sun_azimuth),
            .at = invocation.given(options::at),
            .place = invocation.given(options::place),
            .camera = invocation.given(options::camera),
            .picture_size = invocation.given(options::size),
            .single = invocation[options::single],
            .table_sky = invocation[options::table_sky],
            .turntable = invocation[options::turntable],
            .live = invocation[options::live],
            .threads = invocation[options::jobs]};
}

}  // namespace

namespace options {

// Reads a value that may hold several elevations, separated by commas.
Outcome<std::vector<double>> read_elevations(const std::string& list) {
    Outcome<std::vector<double>> outcome{std::vector<double>(), {}};
    for (const std::string_view text : config::pieces_between(list, ',')) {
        if (const auto elevation = degrees_of(text, -90, 90)) {
            outcome.value->push_back(*elevation);
        } else {
            outcome.diagnostics.push_back(
                not_valid("--sun-elevation", text, "sun elevation",
                          "expected degrees from -90 to 90, such as 40,5,-4"));
        }
    }
    return outcome;
}

Outcome<double> read_azimuth(const std::string& text) {
    return valid(degrees_of(text, -360, 360), "--sun-azimuth", text, "sun azimuth",
                 "expected degrees from -360 to 360, such as 150");
}

Outcome<double> read_exposure(const std::string& text) {
    auto stops = value_of(text, Dimension::number);
    constexpr double most_stops = 64;  // beyond this, every pixel is black or white
    if (stops && !(*stops >= -most_stops && *stops <= most_stops)) stops.reset();
    return valid(stops, "--exposure", text, "exposure",
                 "expected stops from -64 to 64, such as 4 or -1.5");
}

Outcome<double> read_altitude(const std::string& text) {
    auto meters = value_of(text, Dimension::length);
    if (meters && !(*meters >= 0)) meters.reset();
    return valid(meters, "--altitude", text, "altitude",
                 "expected a length of at least 0, such as 2km");
}

Outcome<CameraRequest> read_camera(const std::string& text) {
    Outcome<CameraRequest> outcome{CameraRequest(), {}};
    if (text.find_first_not_of(' ') == std::string::npos) {
        outcome.diagnostics.push_back(usage_error("--camera: the text is empty"));
    }
    for (std::size_t begin = text.find_first_not_of(' '); begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string_view part = std::string_view(text).substr(begin, end - begin);
        begin = std::min(text.find_first_not_of(' ', end), text.size());
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string_view value = part.substr(std::min(equals + 1, part.size()));
        if (read_camera_part(part.substr(0, equals), value, *outcome.value)) continue;
        outcome.diagnostics.push_back(not_valid(
            "--camera", part, "part of a camera",
            "expected some of position=X,Y,Z (Z of at least 0) heading=A pitch=A fov=A, such as "
            "\"position=2km,3km,200m heading=63deg pitch=12deg fov=50deg\""));
    }
    return outcome;
}

Outcome<std::array<int, 2>> read_size(const std::string& text) {
    constexpr int least = 16;
    constexpr int most = 8192;
    const std::string_view view = text;
    const std::size_t by = std::min(view.find('x'), view.size());
    const auto width = parse_count(view.substr(0, by), least, most);
    const auto height = parse_count(view.substr(std::min(by + 1, view.size())), least, most);
    std::optional<std::array<int, 2>> pixels;
    if (width && height) pixels = {*width, *height};
    return valid(pixels, "--size", text, "size",
                 fmt::format("expected pixels from {} to {}, such as 1920x1080", least, most));
}

Outcome<int> read_draft(const std::string& text) {
    return read_count(text, 16, 1024, "--draft", "number of voxels");
}

Outcome<config::Moment> read_time(const std::string& text) {
    return valid(config::parse_moment(text), "--at", text, "date and time",
                 fmt::format("expected {}", config::moment_words));
}

Outcome<EarthPlace> read_place(const std::string& text) {
    const auto pieces = config::pieces_between(text, ',');
    std::optional<EarthPlace> found;
    if (pieces.size() == 2) {
        const auto latitude = degrees_of(pieces[0], -90, 90);
        const auto longitude = degrees_of(pieces[1], -180, 180);
        if (latitude && longitude) found = {*latitude, *longitude};
    }
    return valid(found, "--place", text, "place",
                 "expected degrees of latitude and longitude, positive in the north and in the "
                 "east, such as 47.4,8.5");
}

Outcome<int> read_turntable(const std::string& text) {
    return read_count(text, 2, 360, "--turntable", "number of pictures");
}

}  // namespace options

namespace {

// Chooses the cache. An empty name of a folder stands for none.
std::vector<Diagnostic> choose_cache(const Invocation& invocation, PreviewRequest& request) {
    auto folder = cache_folder(invocation);
    if (!folder.value) return std::move(folder.diagnostics);
    const bool is_named =
        invocation.has(options::cache_dir) || std::getenv("SKYBAKE_CACHE_DIR") != nullptr;
    request.cache = is_named ? std::move(*folder.value) : own_cache_folder();
    request.owns_cache = !is_named;
    return {};
}

}  // namespace

Outcome<PreviewRequest> preview_request(const Invocation& invocation) {
    PreviewRequest request;
    for (const std::string& path : invocation.arguments()) request.paths.emplace_back(path);
    request.subject = subject_of(request.paths[0]);
    for (const fs::path& path : request.paths) {
        if (subject_of(path) != request.subject) request.subject = Subject::recipe;
    }
    request.output = invocation[options::output];
    request.force = invocation[options::force];
    request.watch = invocation[options::watch];

    Outcome<PreviewRequest> outcome;
    std::vector<Diagnostic>& problems = outcome.diagnostics;
    if (request.watch && invocation.has(options::turntable)) {
        problems.push_back(usage_error("--watch and --turntable exclude each other",
                                       "a turntable takes too long to follow every save"));
    }
    check_combination(invocation, request, problems);
    std::ranges::move(choose_cache(invocation, request), std::back_inserter(problems));
    if (invocation.has(options::draft)) request.draft_edge = invocation[options::draft];
    if (invocation.has(options::draft) && !request.watch) {
        problems.push_back(
            usage_error("--draft works only with --watch", "other previews make no drafts"));
    }
    if (!problems.empty()) return outcome;
    request.options = picture_options(invocation);
    outcome.value = std::move(request);
    return outcome;
}

}  // namespace skybake::cli
