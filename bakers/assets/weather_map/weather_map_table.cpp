#include "bakers/assets/weather_map/weather_map_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/weather_map/map_channels.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/pixel_type.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_reference.h"

namespace skybake {
namespace {

using config::WeatherContent;
using config::WeatherMapBake;
using ChannelPlane = Image2<float>;  // of one channel

// The map as a function of the noise, with what has been found about the noise's texels.
class WeatherModel {
  public:
    WeatherModel(const Noise& noise, const WeatherMapBake& bake)
        : noise_(noise), bake_(bake), names_(config::channel_names(noise)), ramps_(names_.size()) {
        const std::array<double, 2> direction = wind_direction(bake.wind.radians);
        for (std::size_t c = 0; c < names_.size(); ++c) {
            streaks_.push_back({gives_amounts() ? bake.streaks[c] : 0, direction});
        }
    }

    const Noise& noise() const { return noise_; }
    const std::vector<std::string>& names() const { return names_; }
    const std::vector<CoverRamp>& ramps() const { return ramps_; }

    // Makes the texels, channels interleaved, and fits the ramps to them. Adds a diagnostic if a
    // share cannot be reached. Incomplete after an interruption.
    Image2<float> make(const BakeOptions& options, std::vector<Diagnostic>& problems) {
        std::vector<ChannelPlane> planes = noise_planes();
        if (gives_amounts()) {
            for (std::size_t c = 0; c < planes.size(); ++c) {
                planes[c] = streaked(planes[c], streaks_[c], options);
            }
            for (const std::size_t channel : order()) cover(channel, planes, problems);
        }
        Image2<float> texels(bake_.size[0], bake_.size[1], static_cast<int>(planes.size()));
        std::vector<double> values(planes.size());
        for (std::size_t i = 0; i < planes.front().texels.size(); ++i) {
            for (std::size_t c = 0; c < planes.size(); ++c) values[c] = double{planes[c].texels[i]};
            if (!gives_amounts()) values = directions(values);
            for (std::size_t c = 0; c < planes.size(); ++c) {
                texels.texels[i * planes.size() + c] = static_cast<float>(values[c]);
            }
        }
        return texels;
    }

    // The map at a place in tiles, from the noise's definition in double precision.
    std::vector<double> reference(double x, double y) const {
        std::vector<double> values(names_.size());
        if (!gives_amounts()) {
            return directions(noise::noise_reference(noise_, {x, y, middle()}));
        }
        for (const std::size_t channel : order()) {
            const double noise = streaked_reference(
                [&](double at_x, double at_y) { return noise_at(channel, at_x, at_y); },
                streaks_[channel], x, y);
            const auto other = yielded_to(channel);
            values[channel] = ramps_[channel](other ? noise - values[*other] : noise);
        }
        return values;
    }

  private:
    bool gives_amounts() const { return bake_.content == WeatherContent::amounts; }

    double noise_at(std::size_t channel, double x, double y) const {
        return noise::noise_reference(noise_, {x, y, middle()})[channel];
    }

    // The plane's place along z, as in a volume of one slice.
    double middle() const { return noise_.sampling == config::NoiseSampling::centers ? 0.5 : 0.0; }

    std::vector<ChannelPlane> noise_planes() const {
        const std::array<int, 3> size = {bake_.size[0], bake_.size[1], 1};
        const noise::NoiseField field(noise::make_noise_plan(noise_, size));
        std::vector<ChannelPlane> planes(names_.size(), ChannelPlane(size[0], size[1], 1));
        std::vector<float*> targets;
        for (ChannelPlane& plane : planes) targets.push_back(plane.texels.data());
        field.fill({{}, size}, targets);
        return planes;
    }

    std::optional<std::size_t> yielded_to(std::size_t channel) const {
        if (bake_.yields_to.empty() || bake_.yields_to[channel].empty()) return std::nullopt;
        const auto found = std::ranges::find(names_, bake_.yields_to[channel]);
        return static_cast<std::size_t>(found - names_.begin());
    }

    // The channels, those first that others yield to.
    std::vector<std::size_t> order() const {
        std::vector<std::size_t> order;
        for (const bool yields : {false, true}) {
            for (std::size_t c = 0; c < names_.size(); ++c) {
                if (yielded_to(c).has_value() == yields) order.push_back(c);
            }
        }
        return order;
    }

    // Replaces a plane of noise by amounts.
    void cover(std::size_t channel, std::vector<ChannelPlane>& planes,
               std::vector<Diagnostic>& problems) {
        std::vector<float>& texels = planes[channel].texels;
        if (const auto other = yielded_to(channel)) {
            const std::vector<float>& taken = planes[*other].texels;
            std::ranges::transform(texels, taken, texels.begin(),
                                   [](float noise, float value) { return noise - value; });
        }
        const FittedRamp fitted =
            fit_cover_ramp(texels, bake_.covered[channel], bake_.full[channel], bake_.edge);
        if (fitted.tied) problems.push_back(tied(channel, *fitted.tied));
        ramps_[channel] = fitted.ramp;
        apply(fitted, texels);
    }

    Diagnostic tied(std::size_t channel, const TiedTexels& ties) const {
        return diagnosis("E0411",
                         fmt::format("channel {} of noise `{}` is {:.6g} at many texels: {:.4g} of "
                                     "them are above that, and "
                                     "{:.4g} with those that are equal",
                                     names_[channel], noise_.name, ties.value, ties.share_above,
                                     ties.share_with_it),
                         "`covered` and `full` cannot lie between these two shares", "covered");
    }

    static std::vector<double> directions(std::vector<double> vector) {
        double squares = 0;
        for (const double part : vector) squares += part * part;
        const double length = std::sqrt(squares);
        // A vector of length 0 has no direction, and becomes the middle of all of them.
        for (double& part : vector) part = length > 0 ? 0.5 + 0.5 * part / length : 0.5;
        return vector;
    }

    const Noise& noise_;
    const WeatherMapBake& bake_;
    std::vector<std::string> names_;
    std::vector<Streaks> streaks_;
    std::vector<CoverRamp> ramps_;
};

std::vector<AxisMapping> axes_of(const Noise& noise, const WeatherMapBake& bake) {
    static constexpr std::array<const char*, 2> kQuantities = {"x_tile", "y_tile"};
    const std::array<double, 2> shift = weather_map_shift(noise, bake);
    std::vector<AxisMapping> axes(2);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string plain = fmt::format("{} = {}", "uv"[i], kQuantities[i]);
        axes[i].quantity = kQuantities[i];
        axes[i].formula =
            shift[i] == 0 ? plain : fmt::format("{} + 1 / (2 * {})", plain, bake.size[i]);
        axes[i].convention = shift[i] == 0 ? "repeats; texel i samples (i + 1/2) / size"
                                           : "repeats; texel i samples i / size";
        axes[i].last = 1;
        axes[i].end_points = TexelConvention::end_points_on_edges;
        axes[i].wrap = AxisWrap::repeat;
        axes[i].constants = {{"offset", shift[i]}};
    }
    return axes;
}

// The share of texels above 0 as they are stored.
std::vector<double> covered_shares(const Image2<float>& texels) {
    const auto channels = static_cast<std::size_t>(texels.channels);
    std::vector<double> shares(channels);
    for (std::size_t i = 0; i < texels.texels.size(); ++i) {
        if (texels.texels[i] > 0) ++shares[i % channels];
    }
    const double count = double{1} * texels.width * texels.height;
    for (double& share : shares) share /= count;
    return shares;
}

void add_details(const WeatherModel& model, const Image2<float>& texels, Baked& table) {
    std::vector<double> low, high;
    for (const CoverRamp& ramp : model.ramps()) {
        if (ramp.none_below == CoverRamp::kInfinity) continue;
        low.push_back(ramp.low);
        high.push_back(ramp.high);
    }
    table.details.emplace_back("covered_texels", covered_shares(texels));
    if (low.empty()) return;
    table.details.emplace_back("noise_at_0", to_digits(low, 9));
    table.details.emplace_back("noise_at_1", to_digits(high, 9));
}

std::string content_of(const WeatherMapBake& bake) {
    return bake.content == WeatherContent::amounts
               ? "amounts of clouds, 0 none to 1 all, dimensionless; the map repeats along x and y"
               : "directions: (1 + unit vector) / 2, dimensionless; the map repeats along x and y";
}

// Makes the table, and has the model know what was found about the texels.
Outcome<Baked> make_table(WeatherModel& model, const WeatherMapBake& bake,
                          const BakeOptions& options, Baked table) {
    Outcome<Baked> outcome;
    Image2<float> texels = model.make(options, outcome.diagnostics);
    if (options.cancelled()) return {};
    if (!outcome.diagnostics.empty()) return outcome;
    round_values(texels.texels.data(), texels.texels.size(), bake.pixel_type);
    table.kind = "weather_map";
    table.content = content_of(bake);
    table.mapping = "tile";
    table.axes = axes_of(model.noise(), bake);
    table.channel_names = model.names();
    set_files(bake, table);
    if (bake.content == WeatherContent::amounts) add_details(model, texels, table);
    set_image(std::move(texels), table);
    outcome.value = std::move(table);
    return outcome;
}

}  // namespace

std::array<double, 2> weather_map_shift(const Noise& noise, const WeatherMapBake& bake) {
    if (noise.sampling != config::NoiseSampling::corners) return {0, 0};
    return {0.5 / bake.size[0], 0.5 / bake.size[1]};
}

Outcome<Baked> make_weather_map(const Noise& noise, const WeatherMapBake& bake,
                                const BakeOptions& options, Baked table) {
    WeatherModel model(noise, bake);
    return make_table(model, bake, options, std::move(table));
}

Outcome<Baked> bake_weather_map(const Noise& noise, const WeatherMapBake& bake,
                                const BakeOptions& options, Baked named) {
    WeatherModel model(noise, bake);
    Outcome<Baked> made = make_table(model, bake, options, std::move(named));
    if (!made.value) return made;
    Baked& table = *made.value;
    add_mip_levels(bake.mips, options, table);
    const std::array<double, 2> shift = weather_map_shift(noise, bake);
    const std::vector<std::array<double, 2>> ranges(model.names().size(), {0, 1});
    return finish_volume(
        std::move(table),
        {.histogram_ranges = ranges,
         .reference =
             [&](const std::array<double, 3>& uvw) {
                 return model.reference(uvw[0] - shift[0], uvw[1] - shift[1]);
             },
         .reference_name = "the noise's definition in double precision, point by point, with the "
                           "ramps that the texels gave",
         .expensive = std::ranges::any_of(bake.streaks, [](double length) { return length > 0; }),
         .probe_place =
             [&](const std::array<double, 3>& uvw, int) {
                 ProbePlace place{{}, {{{uvw[0], uvw[1], 0.5}}}};
                 for (std::size_t i = 0; i < 2; ++i) {
                     const double at = uvw[i] - shift[i];
                     place.at.emplace_back(i == 0 ? "x_tile" : "y_tile", at - std::floor(at));
                 }
                 return place;
             }},
        options);
}

}  // namespace skybake
