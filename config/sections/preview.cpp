#include "config/sections/preview.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/fields/fields.h"
#include "config/fields/number_reader.h"
#include "config/sections/sections.h"
#include "config/text/moment.h"

namespace skybake::config {
namespace {

constexpr Range picture_range{16, 8192};  // pixels
constexpr Range position_range{-1e7, 1e7};
constexpr Range whole_turn{-2 * std::numbers::pi, 2 * std::numbers::pi};
constexpr Range longitude_range{-std::numbers::pi, std::numbers::pi};
constexpr Range field_of_view_range{std::numbers::pi / 180, 160 * std::numbers::pi / 180};
constexpr Range stops_range{-32, 32};  // beyond this, every pixel is black or white

constexpr std::array tone_curve_choices = {
    Choice{ToneCurve::film, "film",
           "a toe and a shoulder that keep hues; the brightest turns white"},
    Choice{ToneCurve::exponential, "exponential", "1 - exp(-light), of each channel"},
    Choice{ToneCurve::aces, "aces", "a fit to the film-like curve of ACES; bright turns white"},
    Choice{ToneCurve::agx, "agx", "the base look of AgX, which keeps the hues of bright colours"},
};
constexpr std::array glare_choices = {
    Choice{Glare::none, "none", "the disc alone"},
    Choice{Glare::camera, "camera", "a lens scatters a hundredth of the sun's light"},
    Choice{Glare::eye, "eye", "an eye scatters two thirds of it, most of it by less than a degree"},
};

// Reads a text that parse_moment understands.
std::optional<FieldValue> read_moment(const Reader& reader, const Value& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (text != nullptr && parse_moment(*text)) return *text;
    if (text == nullptr) {
        report_type(reader, value, moment_words);
    } else {
        reader.error("E0110", value,
                     fmt::format("`{}` is not a date and time: {}", reader.path, written(value)),
                     fmt::format("expected {}", moment_words));
    }
    return std::nullopt;
}

constexpr ValueKind moment_kind{moment_words, read_moment, text_schema};

constexpr std::string_view sun = "sun";
constexpr std::string_view by_time = "time";
constexpr std::string_view by_angles = "angles";

// The keys have no default values. So the parameters that a manifest records have only keys that the
// recipe gives, which its pictures use.
const std::array preview_table = {
    PreviewField{{.key = "size",
                  .kind = Kind::size,
                  .range = picture_range,
                  .documentation = "width and height of pictures of clouds, in pixels",
                  .hint = "960 x 540 without it"},
                 &Preview::size},
    PreviewField{{.key = "single",
                  .kind = Kind::flag,
                  .documentation = "whether a single tile of a cloud is shown, framed as a whole, "
                                   "and not the layer that it repeats to"},
                 &Preview::single},
    PreviewField{{.key = "altitude",
                  .kind = Kind::length,
                  .range = camera_altitude_range,
                  .documentation = "altitude of the camera that looks at the sky",
                  .hint = "without it, the camera is at 200 m"},
                 &Preview::altitude},
    PreviewField{{.key = "sun_elevation",
                  .kind = Kind::angles,
                  .range = elevation_range,
                  .documentation = "elevations of the sun, each of which gets a picture",
                  .hint = "without it, skybake chooses them",
                  .exclusive_group = sun,
                  .exclusive_side = by_angles},
                 &Preview::sun_elevation},
    PreviewField{{.key = "sun_azimuth",
                  .kind = Kind::angle,
                  .range = whole_turn,
                  .documentation = "where the sun of clouds stands, from +x towards +y",
                  .hint = "without it, the sun stands 112 deg to the left of the view",
                  .exclusive_group = sun,
                  .exclusive_side = by_angles},
                 &Preview::sun_azimuth},
    PreviewField{
        {.key = "at",
         .kind = moment_kind,
         .documentation = "date and time that place the sun, at latitude and longitude; +y "
                          "is north and +x is east",
         .citation = "Meeus 1998, Astronomical Algorithms, chapter 25",
         .exclusive_group = sun,
         .exclusive_side = by_time},
        &Preview::at},
    PreviewField{{.key = "latitude",
                  .kind = Kind::angle,
                  .range = elevation_range,
                  .documentation = "latitude of the place, positive in the north"},
                 &Preview::latitude},
    PreviewField{{.key = "longitude",
                  .kind = Kind::angle,
                  .range = longitude_range,
                  .documentation = "longitude of the place, positive in the east"},
                 &Preview::longitude},
    PreviewField{{.key = "exposure",
                  .kind = Kind::number,
                  .range = stops_range,
                  .documentation = "exposure in stops; 0 is a factor of 1",
                  .hint = "without it, skybake chooses one for each picture"},
                 &Preview::exposure},
    PreviewField{{.key = "tone_curve",
                  .kind = Kind::choice,
                  .choices = tone_curve_choices,
                  .documentation = "how light becomes the brightness of a screen",
                  .hint = "without it, the curve is film"},
                 &Preview::tone_curve},
    PreviewField{{.key = "glare",
                  .kind = Kind::choice,
                  .choices = glare_choices,
                  .documentation = "what light lies around the sun's disc in pictures of skies",
                  .hint = "without it, there is no glare"},
                 &Preview::glare},
};

const std::array camera_table = {
    PreviewCameraField{{.key = "position",
                        .kind = Kind::lengths,
                        .range = position_range,
                        .documentation = "x and y from the tile's corner, and the altitude above "
                                         "the ground"},
                       &PreviewCamera::position},
    PreviewCameraField{{.key = "heading",
                        .kind = Kind::angle,
                        .range = whole_turn,
                        .documentation = "where the camera looks, from +x towards +y"},
                       &PreviewCamera::heading},
    PreviewCameraField{{.key = "pitch",
                        .kind = Kind::angle,
                        .range = elevation_range,
                        .documentation = "how far above the horizontal it looks"},
                       &PreviewCamera::pitch},
    PreviewCameraField{{.key = "fov",
                        .kind = Kind::angle,
                        .range = field_of_view_range,
                        .documentation = "angle across the picture"},
                       &PreviewCamera::fov},
};

bool is_one_of(std::string_view key, std::initializer_list<std::string_view> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

std::span<const PreviewField> preview_fields() { return preview_table; }

std::span<const PreviewCameraField> preview_camera_fields() { return camera_table; }

std::string_view why_unused(std::string_view key, const PicturesOfLight& pictures) {
    if (is_one_of(key, {"altitude", "glare"}) && !pictures.sky) {
        return key == "altitude" && pictures.clouds
                   ? "only pictures of a sky use it; `camera` places the camera of a cloud"
                   : "only pictures of a sky use it, which need a transmittance and a "
                     "multiple_scattering table";
    }
    if (is_one_of(key, {"camera", "size", "single", "turntable", "sun_azimuth"}) &&
        !pictures.clouds) {
        return "only pictures of a lit cloud use it, which need a [bake.*] cloud_volume";
    }
    if (!pictures.sky && !pictures.clouds) {
        return "only pictures of a sky or of a lit cloud use it";
    }
    return "";
}

}  // namespace skybake::config
