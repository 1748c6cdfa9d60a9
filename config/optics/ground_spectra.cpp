#include "config/optics/ground_spectra.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace skybake::config {
namespace {

struct AlbedoRow {
    double nm, albedo;
};

// Green leaves, and dry sand: the means that 6S has for its surfaces (Vermote, Tanre, Deuze, Herman &
// Morcrette 1997, IEEE Trans. Geosci. Remote Sens. 35, 675), there every 2.5 nm from 400 nm, from the
// Manual of Remote Sensing (1983) and from Staetter & Schroeder (1978). These rows hold them within
// 0.005 by linear interpolation up to 800 nm.
constexpr AlbedoRow kVegetation[] = {{400, 0.06},  {460, 0.084}, {505, 0.119}, {540, 0.134},
                                     {605, 0.083}, {640, 0.073}, {660, 0.079}, {665, 0.1},
                                     {670, 0.138}, {705, 0.35},  {720, 0.436}, {735, 0.509},
                                     {750, 0.519}, {800, 0.524}};
constexpr AlbedoRow kSand[] = {{400, 0.091}, {470, 0.097}, {505, 0.107}, {535, 0.125}, {590, 0.134},
                               {605, 0.149}, {645, 0.169}, {720, 0.233}, {800, 0.273}};

// Clean new snow with grains of 0.2 mm: exp(-3.6 sqrt(4 pi k d / wavelength)) of Kokhanovsky & Zege
// 2004 (Appl. Opt. 43, 1589), with the absorption k of ice by Warren & Brandt 2008 (J. Geophys. Res.
// 113, D14220). Snow has 0.96 to 0.99 in visible light (Wiscombe & Warren 1980, J. Atmos. Sci. 37).
constexpr AlbedoRow kSnow[] = {{400, 0.9986}, {450, 0.9974}, {500, 0.9938},
                               {550, 0.9884}, {600, 0.9825}, {650, 0.9736},
                               {700, 0.9639}, {750, 0.9508}, {800, 0.9288}};

// The open sea with 0.1 mg/m3 of chlorophyll: the irradiance reflectance R of Morel 1988 (J. Geophys.
// Res. 93, 10749) below a level surface that reflects 0.066 of diffuse light from above and 0.485
// from below, 0.066 + 0.934 * 0.515 R / (1 - 0.485 R). These rows hold it within 0.001.
constexpr AlbedoRow kSea[] = {{400, 0.0921}, {475, 0.0851}, {495, 0.0811},
                              {520, 0.0738}, {600, 0.0673}, {700, 0.0664}};

// Mars: the geometric albedos in seven bands from U to I of Mallama, Krobusek & Pavlov 2017 (Icarus
// 282, 19, table 7), at the bands' effective wavelengths. Their mean over sunlight from 400 to 1080
// nm is 0.23; the rovers' cameras found Lambert albedos of 0.11 to 0.24 in that band (Bell et al. 2008,
// J. Geophys. Res. 113, E06S18).
constexpr AlbedoRow kMars[] = {{360, 0.06},  {436, 0.088}, {549, 0.17}, {641, 0.25},
                               {700, 0.288}, {798, 0.285}, {900, 0.33}};

// In the order of the enumerators.
constexpr std::span<const AlbedoRow> kGrounds[] = {kVegetation, kSand, kSnow, kSea, kMars};

}  // namespace

std::vector<SpectrumPoint> spectrum_of(Ground ground) {
    std::vector<SpectrumPoint> spectrum;
    for (const AlbedoRow& row : kGrounds[static_cast<std::size_t>(ground)]) {
        spectrum.push_back({{row.nm / 1e9}, row.albedo});
    }
    return spectrum;
}

double albedo_at(const std::vector<SpectrumPoint>& spectrum, Length wavelength) {
    assert(spectrum.size() >= 2);
    const auto above = std::upper_bound(
        spectrum.begin() + 1, spectrum.end() - 1, wavelength.meters,
        [](double wanted, const SpectrumPoint& point) { return wanted < point.wavelength.meters; });
    const auto below = above - 1;
    const double from = below->wavelength.meters;
    const double share = (wavelength.meters - from) / (above->wavelength.meters - from);
    return below->value + (above->value - below->value) * std::clamp(share, 0.0, 1.0);
}

}  // namespace skybake::config
