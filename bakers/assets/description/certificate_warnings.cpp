#include "bakers/assets/description/certificate_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

// Root mean squares, of what the errors are relative to. The maximum says less: next to an edge of the
// shadow one lookup may be many times too bright.
constexpr double kLargeLookups = 0.3;
constexpr double kLargeTexels = 0.05;
// Relative: the median of the sky, nine in ten colours, and the sun's disc at 5 and 1 degrees.
constexpr double kLargeSky = 0.1;
constexpr double kLargeColors = 0.03;
constexpr double kLargeDisc = 0.05;

bool is_far_off(const ColorError& color) {
    return !(color.ninth_decile <= kLargeColors && std::fabs(color.disc[0]) <= kLargeDisc &&
             std::fabs(color.disc[1]) <= kLargeDisc);
}

std::string at_place(const std::string& place) { return place.empty() ? "" : "; most at " + place; }

// Says how few values a pixel type of equal steps leaves of dim light; nothing of other types.
std::string steps_text(const Baked& baked) {
    const PixelType type = baked.pixel_type;
    if (type != PixelType::unorm8 && type != PixelType::unorm16) return "";
    double largest = 0;
    for (const ValueStatistics& channel : baked.levels.front().statistics) {
        largest = std::max(largest, channel.max);
    }
    const double step = 2 * rounding_error(type);
    return fmt::format(
        "use pixel_type = \"half\": the steps of the file are equal, and its largest value, "
        "{:.2g}, is step {:.0f} of {:.0f}",
        largest, std::floor(largest / step + 0.5), 1 / step);
}

std::string advice_on_texels(const Baked& baked) {
    if (baked.kind == "cloud_distance") return "use a smaller cell";
    if (const std::string steps = steps_text(baked); !steps.empty()) return steps;
    if (baked.kind == "multiple_scattering" || baked.kind == "irradiance") {
        return "ask for a smaller max_texel_error";
    }
    if (config::is_block_coded(baked.pixel_type))
        return "use pixel_type = \"half\": blocks hold few values";
    if (baked.kind == "bruneton") return "use a larger size";
    if (baked.kind == "cloud_light") return "use a smaller cell, or contents that vary less";
    if (baked.kind == "optical_depth") {
        return "use more shells, a greater max_altitude, or sampling = \"exact\"";
    }
    if (baked.kind == "environment") return "use more samples, or layers whose edges fade out";
    return "a larger size does not help, since the texels themselves are off; give layers with "
           "hard edges a profile that fades out";
}

std::string advice_on_sky(const Baked& baked) {
    if (const std::string steps = steps_text(baked); !steps.empty()) return steps;
    const std::string& better = baked.certificate.sky->better;
    if (!better.empty()) return better + "; a sky_view of the camera has the least";
    if (baked.kind == "multiple_scattering" || baked.kind == "bruneton") {
        return "a sky_view of the camera and its suns has a smaller error";
    }
    if (baked.kind == "aerial_perspective") {
        return "use more slices, a smaller view_distance, or from space slices_begin = \"air\"";
    }
    const Certificate& certificate = baked.certificate;
    return certificate.lookup.rms > 2 * certificate.texel.rms
               ? "use a larger size"
               : "use an air whose phase functions are less peaked, or a larger size, and compare "
                 "with --certify=full";
}

std::string advice_on_colors(const Parameters& parameters) {
    const std::size_t count = parameters.wavelengths.size();
    if (count < 8) return "wavelengths = \"best 8\" come nearer";
    if (count < 16) return "wavelengths = \"best 16\" come nearer";
    return "bake the wavelengths themselves (space = \"none\"), and make colours of their spectra";
}

std::string advice_on(const std::string& code, const Parameters& parameters, const Baked& baked) {
    if (code == "W0220") return advice_on_texels(baked);
    if (code == "W0221") return advice_on_sky(baked);
    if (code == "W0222") return advice_on_colors(parameters);
    if (baked.kind == "phase") return "use a larger size or another spacing";
    return "use a larger size or another mapping, or thicker layers of air";
}

}  // namespace

double to_percent(double share) { return to_digits(100 * share, 2); }

std::vector<LargeError> large_errors(const Certificate& certificate) {
    std::vector<LargeError> large;
    const ErrorFigures& texel = certificate.texel;
    const ErrorFigures& lookup = certificate.lookup;
    if (!(texel.rms <= kLargeTexels)) {
        large.push_back(
            {"W0220",
             fmt::format("texels are off by up to {:.3g}, root mean square {:.3g} (scale: {})",
                         texel.max, texel.rms, certificate.scale)});
    }
    // Where texels are as far off as lookups between them, more of them do not help.
    if (!(lookup.rms < kLargeLookups) && !(texel.rms > 0.5 * lookup.rms)) {
        large.push_back(
            {"W0214",
             fmt::format("lookups are off by up to {:.3g}, root mean square {:.3g} (scale: {}){}",
                         lookup.max, lookup.rms, certificate.scale, at_place(certificate.worst))});
    }
    const auto& sky = certificate.sky;
    if (sky && sky->points > 0 && !(sky->median <= kLargeSky)) {
        large.push_back(
            {"W0221",
             fmt::format(
                 "its sky is off by {} % in the median and up to {} %, beside paths of light{}",
                 to_percent(sky->median), to_percent(sky->max), at_place(sky->worst))});
    }
    const auto& color = certificate.color;
    if (color && is_far_off(*color)) {
        large.push_back(
            {"W0222", fmt::format("colours are off by {} % of luminance in one view of ten, and "
                                  "those of the sun at 5 and 1 degrees by {} and {} %",
                                  to_percent(color->ninth_decile), to_percent(color->disc[0]),
                                  to_percent(color->disc[1]))});
    }
    return large;
}

std::vector<Diagnostic> warn_of_large_errors(const Parameters& parameters, Baked& baked) {
    std::vector<Diagnostic> warnings;
    if (!baked.certified) return warnings;
    Certificate& certificate = baked.certificate;
    for (const LargeError& error : large_errors(certificate)) {
        // All assets of a recipe have the same colours, and one warning of them suffices.
        const std::string subject = error.code == "W0222" ? "" : fmt::format("`{}`: ", baked.name);
        Diagnostic warning =
            diagnosis(error.code, subject + error.text, advice_on(error.code, parameters, baked),
                      error.code == "W0214" ? "size" : "");
        if (!certificate.advice.empty()) certificate.advice += "; ";
        certificate.advice += warning.label;
        warnings.push_back(std::move(warning));
    }
    if (certificate.advice.empty() && certificate.sky && certificate.sky->points == 0) {
        certificate.advice =
            "too little light reaches it for paths to tell its sky error; under a higher sun they "
            "do";
    }
    return warnings;
}

}  // namespace skybake
