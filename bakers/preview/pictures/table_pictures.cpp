#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "bakers/field/interpolation.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/table_geometry.h"
#include "bakers/render/screen_color.h"
#include "bakers/render/tone_curve.h"

namespace skybake {
namespace {

constexpr int drawn_width = 512;
constexpr int drawn_height = 320;
constexpr int profile_points = 400;
constexpr std::uint8_t no_ray_grey = 0xd4;

struct ChannelName {
    std::string stem;   // "red"
    std::string title;  // "red, 680 nm"
    std::array<std::uint8_t, 3> colour{};
};

std::vector<ChannelName> channel_names(const ManifestAsset& entry, const TableGeometry& geometry) {
    const std::vector<double>& wavelengths = geometry.wavelengths_nm();
    const auto title = [&](const std::string& name, std::size_t i) {
        if (i >= wavelengths.size()) return name;
        const std::string length = fmt::format("{:.5g} nm", wavelengths[i]);
        return name.empty() ? length : name + ", " + length;
    };
    constexpr std::array<std::uint8_t, 3> red = {0xc8, 0x3a, 0x32}, amber = {0xb8, 0x86, 0x0b},
                                          green = {0x2e, 0x8b, 0x57}, blue = {0x2f, 0x6f, 0xc4};
    const std::size_t count = entry.channels.size();
    if (count == 1) return {{"luminance", title("", 0), {0x1f, 0x23, 0x28}}};
    const bool falling = std::is_sorted(wavelengths.rbegin(), wavelengths.rend());
    if (count == 3 && falling && !entry.conventions.color) {
        return {{"red", title("red", 0), red},
                {"green", title("green", 1), green},
                {"blue", title("blue", 2), blue}};
    }
    // Channels that only a matrix turns into colours are named by their wavelengths, and drawn from
    // red to blue.
    std::vector<std::array<std::uint8_t, 3>> hues = {red, amber, green, blue};
    if (count < hues.size()) hues = {red, green, blue};
    std::vector<ChannelName> names;
    for (std::size_t i = 0; i < count; ++i) {
        const auto longer = std::ranges::count_if(
            wavelengths, [&](double nm) { return i < wavelengths.size() && nm > wavelengths[i]; });
        const auto rank = std::min(static_cast<std::size_t>(longer), hues.size() - 1);
        names.push_back({fmt::format("channel_{}", i), title("", i), hues[rank]});
    }
    return names;
}

// The words and the scale that differ between the kinds of tables.
struct Quantity {
    std::string heading;  // "Transmittance"
    std::string axis;     // "transmittance"
    std::string angle;    // of the horizontal axis
    bool logarithmic = false;
};

Quantity quantity_of(const TableGeometry& geometry) {
    if (!geometry.is_transmittance()) {
        const bool has_moments = geometry.tables() > 1;
        return {has_moments ? "Mean radiance, the first moment" : "Multiple scattering", "Ψ (1/sr)",
                "sun zenith angle (deg)", true};
    }
    if (geometry.holds_optical_depth()) {
        return {"Optical depth", "optical depth to the top", "zenith angle of the ray (deg)", true};
    }
    return {"Transmittance", "transmittance to the top", "zenith angle of the ray (deg)", false};
}

ColourScale scale_of(const Image2<float>& table, int channel, const Quantity& quantity) {
    if (!quantity.logarithmic) return {0, 1, false, false, quantity.axis};
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (std::size_t i = static_cast<std::size_t>(channel); i < table.texels.size();
         i += static_cast<std::size_t>(table.channels)) {
        const double value = double{table.texels[i]};
        if (value > 0) low = std::min(low, value);
        high = std::max(high, value);
    }
    if (!(high > 0)) return {0, 1, false, false, quantity.axis};
    // The scale spans at most six decades: from full daylight to a night that no exposure can show
    // beside it.
    low = std::max(low, high * 1e-6);
    return {low == high ? low / 2 : low, high, true, false, quantity.axis};
}

// --- Lookups over physical axes -----------------------------------------------------------------

// Returns the zenith angle of the horizon seen from the top, rounded up to a multiple of 5 degrees.
double widest_angle(const TableGeometry& geometry) {
    return std::min(180.0,
                    5 * std::ceil(geometry.largest_zenith_angle(geometry.thickness_km()) / 5));
}

// Returns lookups over zenith angle and altitude; NaN if the ray hits the ground. Row 0 is the
// ground.
Image2<float> physical_view(const Image2<float>& table, const TableGeometry& geometry) {
    Image2<float> view(drawn_width, drawn_height, table.channels);
    std::vector<double> value(static_cast<std::size_t>(table.channels));
    const double widest = widest_angle(geometry);
    for (int y = 0; y < view.height; ++y) {
        const double altitude = (y + 0.5) / view.height * geometry.thickness_km();
        const double horizon = geometry.largest_zenith_angle(altitude);
        for (int x = 0; x < view.width; ++x) {
            const double angle = (x + 0.5) / view.width * widest;
            if (angle > horizon) {
                std::fill_n(view.texel(x, y), view.channels,
                            std::numeric_limits<float>::quiet_NaN());
                continue;
            }
            const auto uv = geometry.texture_coordinates(altitude, angle);
            bilinear(table, uv[0], uv[1], value.data());
            std::ranges::transform(value, view.texel(x, y),
                                   [](double v) { return static_cast<float>(v); });
        }
    }
    return view;
}

// Returns a table's texels as light: optical depths become transmittances.
Image2<float> light_of(const Image2<float>& table, const TableGeometry& geometry) {
    Image2<float> light = table;
    if (!geometry.holds_optical_depth()) return light;
    for (float& value : light.texels) value = std::exp(-value);
    return light;
}

// Tone-maps a field. The picture's row 0 is at the top; places without a ray are grey.
Picture shown(const Image2<float>& field, double exposure) {
    Image2<float> view = upwards(field, 0, field.height);
    std::vector<std::size_t> missing;
    const auto channels = static_cast<std::size_t>(view.channels);
    for (std::size_t i = 0; i < view.texels.size(); i += channels) {
        if (!std::isnan(view.texels[i])) continue;
        missing.push_back(i / channels);
        std::fill_n(view.texels.begin() + static_cast<std::ptrdiff_t>(i), view.channels, 0.0F);
    }
    Picture picture = tone_mapped(view, exposure);
    for (const std::size_t pixel : missing) {
        std::fill_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, no_ray_grey);
    }
    return picture;
}

// --- Texels as they lie -------------------------------------------------------------------------

PreviewPicture texels_picture(const ManifestAsset& entry, const Image2<float>& light,
                              double exposure, const ChartAxis& across, const ChartAxis& up) {
    const std::string title =
        fmt::format("{}: {} × {} texels", entry.name, light.width, light.height);
    return {
        entry.name + "_texels", title,
        fmt::format("The picture shows the file's texels, with its first row at the bottom; {}.",
                    tone_text(exposure)),
        framed(shown(fitted(light, drawn_width, 2 * drawn_width), exposure), title, across, up)};
}

// --- Pictures -----------------------------------------------------------------------------------

class TablePictures {
  public:
    TablePictures(const PreviewAsset& asset, const TableGeometry& geometry)
        : entry_(asset.entry),
          table_(asset.table),
          light_(light_of(asset.table, geometry)),
          geometry_(geometry),
          quantity_(quantity_of(geometry)),
          channels_(channel_names(asset.entry, geometry)),
          view_(physical_view(asset.table, geometry)),
          screen_(asset.entry.conventions, asset.table.channels),
          exposure_(exposure_for(screen_.shown(light_))) {}

    std::vector<PreviewPicture> make() {
        add_colours();
        for (int channel = 0; channel < static_cast<int>(channels_.size()); ++channel) {
            add_false_colours(channel);
        }
        add_profile_over_angle();
        add_profile_over_altitude();
        add_texels();
        return std::move(pictures_);
    }

  private:
    ChartAxis angle_axis() const {
        const double widest = widest_angle(geometry_);
        return {quantity_.angle, [widest](double t) { return t * widest; }, AxisTicks::angles};
    }
    ChartAxis altitude_axis() const {
        return linear_axis("altitude (km)", 0, geometry_.thickness_km());
    }

    void add(const std::string& stem, const std::string& title, std::string caption,
             Picture picture) {
        pictures_.push_back(
            {entry_.name + "_" + stem, title, std::move(caption), std::move(picture)});
    }

    std::string where_grey() const {
        return geometry_.is_transmittance() ? " Where the picture is grey, the ray hits the ground."
                                            : "";
    }

    void add_colours() {
        const std::string title =
            (geometry_.is_transmittance() ? "Transmittance" : quantity_.heading) +
            std::string(" as colour");
        add("view", title,
            fmt::format("The picture shows bilinear lookups; {}.{}", tone_text(exposure_),
                        where_grey()),
            framed(shown(screen_.shown(light_of(view_, geometry_)), exposure_), title, angle_axis(),
                   altitude_axis()));
    }

    void add_false_colours(int channel) {
        const ChannelName& name = channels_[static_cast<std::size_t>(channel)];
        const std::string title = quantity_.heading + ", " + name.title;
        const ColourScale scale = scale_of(table_, channel, quantity_);
        add(name.stem, title,
            fmt::format("The picture shows bilinear lookups over zenith angle and altitude{}.{}",
                        scale.logarithmic ? ", on a logarithmic scale" : "", where_grey()),
            false_colour_chart(channel_of(view_, static_cast<std::size_t>(channel)), scale, title,
                               angle_axis(), altitude_axis(), drawn_width));
        pictures_.back().titled = true;
        pictures_.back().group = "channels";
        pictures_.back().tab = name.title;
    }

    // Leaves out values below the scale of the false colours, which would otherwise fill the chart.
    void hide_night(std::vector<ChartLine>& lines) const {
        for (std::size_t channel = 0; channel < lines.size(); ++channel) {
            const ColourScale scale = scale_of(table_, static_cast<int>(channel), quantity_);
            for (double& value : lines[channel].y) {
                if (value < scale.low) value = std::numeric_limits<double>::quiet_NaN();
            }
        }
    }

    // Returns lookups along a line of places, as one curve per channel.
    std::vector<ChartLine> curves(
        const std::function<std::array<double, 3>(double)>& x_altitude_angle) const {
        std::vector<ChartLine> lines;
        for (const ChannelName& name : channels_)
            lines.push_back({name.title, name.colour, {}, {}});
        std::vector<double> value(static_cast<std::size_t>(table_.channels));
        for (int i = 0; i <= profile_points; ++i) {
            const auto [x, altitude, angle] =
                x_altitude_angle(static_cast<double>(i) / profile_points);
            const auto uv = geometry_.texture_coordinates(altitude, angle);
            bilinear(table_, uv[0], uv[1], value.data());
            for (std::size_t channel = 0; channel < lines.size(); ++channel) {
                lines[channel].x.push_back(x);
                lines[channel].y.push_back(value[channel]);
            }
        }
        if (quantity_.logarithmic) hide_night(lines);
        return lines;
    }

    void add_curves(const std::string& stem, const std::string& title, const std::string& across,
                    const std::vector<ChartLine>& lines, const std::string& caption) {
        add(stem, title, caption,
            line_chart(lines, title, across, quantity_.axis, false, quantity_.logarithmic));
        pictures_.back() = as_plot(std::move(pictures_.back()));
    }

    void add_profile_over_angle() {
        const double horizon = geometry_.largest_zenith_angle(0);
        const auto lines = curves([&](double t) {
            return std::array<double, 3>{t * horizon, 0.0, t * horizon};
        });
        const std::string title = quantity_.heading + " at the ground";
        add_curves("ground_profile", title, quantity_.angle, lines,
                   "The curves show bilinear lookups at the ground, altitude 0.");
    }

    void add_profile_over_altitude() {
        const double thickness = geometry_.thickness_km();
        const auto lines = curves([&](double t) {
            return std::array<double, 3>{t * thickness, t * thickness, 90.0};
        });
        const std::string title =
            quantity_.heading +
            (geometry_.is_transmittance() ? " along the horizontal" : " with the sun at 90°");
        add_curves("altitude_profile", title, "altitude (km)", lines,
                   "The curves show bilinear lookups at a zenith angle of 90 degrees.");
    }

    void add_texels() {
        const TableGeometry geometry = geometry_;
        const ChartAxis up{"altitude (km)",
                           [geometry](double t) { return geometry.altitude_km(t); },
                           AxisTicks::decimal};
        const ChartAxis across =
            geometry.is_transmittance()
                ? linear_axis("u: straight up on the left, the horizon on the right", 0, 1)
                : ChartAxis{quantity_.angle,
                            [geometry](double t) { return geometry.zenith_angle(t, 0); },
                            AxisTicks::angles};
        pictures_.push_back(texels_picture(entry_, screen_.shown(light_), exposure_, across, up));
    }

    const ManifestAsset& entry_;
    const Image2<float>& table_;
    const Image2<float> light_;
    const TableGeometry& geometry_;
    Quantity quantity_;
    std::vector<ChannelName> channels_;
    Image2<float> view_;
    ScreenColor screen_;
    double exposure_;
    std::vector<PreviewPicture> pictures_;
};

}  // namespace

std::vector<PreviewPicture> table_pictures(const PreviewAsset& asset) {
    const Image2<float>& table = asset.table;
    if (table.width <= 0 || table.height <= 0 || table.channels <= 0) return {};
    if (const auto geometry = TableGeometry::of(asset.entry)) {
        PreviewAsset first = asset;
        first.table.height /= geometry->tables();
        first.table.texels.resize(first.table.texels.size() /
                                  static_cast<std::size_t>(geometry->tables()));
        return TablePictures(first, *geometry).make();
    }
    const Image2<float> colors = ScreenColor(asset.entry.conventions, table.channels).shown(table);
    return {texels_picture(asset.entry, colors, exposure_for(colors), linear_axis("u", 0, 1),
                           linear_axis("v", 0, 1))};
}

}  // namespace skybake
