#include "config/sections/preview.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/fields/fields.h"
#include "config/fields/number_reader.h"
#include "config/sections/sections.h"
#include "config/text/moment.h"

namespace skybake::config {
namespace {

constexpr Range stops_range{-64, 64};  // beyond this, every pixel is black or white

constexpr Choice tone_curve_choices[] = {
    {ToneCurve::film, "film", "a toe and a shoulder that keep hues; the brightest turns white"},
    {ToneCurve::exponential, "exponential", "1 - exp(-light), of each channel"},
    {ToneCurve::aces, "aces", "a fit to the film-like curve of ACES; bright turns white"},
    {ToneCurve::agx, "agx", "the base look of AgX, which keeps the hues of bright colours"},
};
constexpr Choice glare_choices[] = {
    {Glare::none, "none", "the disc alone"},
    {Glare::camera, "camera", "a lens scatters a hundredth of the sun's light"},
    {Glare::eye, "eye", "an eye scatters two thirds of it, most of it by less than a degree"},
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

// The keys have no default values. So the parameters that a manifest records have only keys that the
// recipe gives, which its pictures use.
const Row<Preview> preview_table[] = {
    {"size", Kind::size, &Preview::size, "width and height of pictures of clouds, in pixels",
     Range{16, 8192}, Hint{"960 x 540 without it"}},
    {"single", Kind::flag, &Preview::single,
     "whether a single tile of a cloud is shown, framed as a whole, and not the layer that it "
     "repeats to"},
    {"altitude", Kind::length, &Preview::altitude, "altitude of the camera that looks at the sky",
     camera_altitude_range, Hint{"without it, the camera is at 200 m"}},
    {"sun_elevation", Kind::angles, &Preview::sun_elevation,
     "elevations of the sun, each of which gets a picture", elevation_range,
     Hint{"without it, skybake chooses them"}, Exclusive{"sun", "angles"}},
    {"sun_azimuth", Kind::angle, &Preview::sun_azimuth,
     "where the sun of clouds stands, from +x towards +y", turn_range,
     Hint{"without it, the sun stands 112 deg to the left of the view"},
     Exclusive{"sun", "angles"}},
    {"at", moment_kind, &Preview::at,
     "date and time that place the sun, at latitude and longitude; +y is north and +x is east",
     Exclusive{"sun", "time"}, Cited{"Meeus 1998, Astronomical Algorithms, chapter 25"}},
    {"latitude", Kind::angle, &Preview::latitude, "latitude of the place, positive in the north",
     elevation_range},
    {"longitude", Kind::angle, &Preview::longitude, "longitude of the place, positive in the east",
     Range{-std::numbers::pi, std::numbers::pi}},
    {"exposure", Kind::number, &Preview::exposure, "exposure in stops; 0 is a factor of 1",
     stops_range, Hint{"without it, skybake chooses one for each picture"}},
    {"tone_curve", Kind::choice, &Preview::tone_curve,
     "how light becomes the brightness of a screen", tone_curve_choices,
     Hint{"without it, the curve is film"}},
    {"glare", Kind::choice, &Preview::glare,
     "what light lies around the sun's disc in pictures of skies", glare_choices,
     Hint{"without it, there is no glare"}},
};

const Row<PreviewCamera> camera_table[] = {
    {"position", Kind::lengths, &PreviewCamera::position,
     "x and y from the tile's corner, and the altitude above the ground", Range{-1e7, 1e7}},
    {"heading", Kind::angle, &PreviewCamera::heading, "where the camera looks, from +x towards +y",
     turn_range},
    {"pitch", Kind::angle, &PreviewCamera::pitch, "how far above the horizontal it looks",
     elevation_range},
    {"fov", Kind::angle, &PreviewCamera::fov, "angle across the picture",
     Range{std::numbers::pi / 180, 160 * std::numbers::pi / 180}},
};

bool is_one_of(std::string_view key, std::initializer_list<std::string_view> keys) {
    return std::ranges::find(keys, key) != keys.end();
}

}  // namespace

std::span<const Row<Preview>> preview_fields() { return preview_table; }

std::span<const Row<PreviewCamera>> preview_camera_fields() { return camera_table; }

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
