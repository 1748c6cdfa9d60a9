// Hess, Koepke & Schult 1998 (Bull. Amer. Meteor. Soc. 79, 831) and the data files of OPAC 3.1,
// which are free for research and cited as that paper. Numbers are typed from the paper's tables
// 1c, 4 and 5 and compared with copies of the data files; refractive indices go back to d'Almeida,
// Koepke & Shettle 1991 and Palmer & Williams 1975.
#include "config/optics/aerosol_components.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "config/optics/interpolated_table.h"
#include "config/text/mapped.h"

namespace skybake::config {
namespace {

constexpr std::size_t kHumidityCount = 8;
constexpr std::array<double, kHumidityCount> kTabulatedHumidities_percent = {0,  50, 70, 80,
                                                                             90, 95, 98, 99};
using HumidRadii = std::array<double, kHumidityCount>;  // um, at those humidities

constexpr HumidRadii same_when_humid(double um) { return {um, um, um, um, um, um, um, um}; }

struct IndexRow {
    double nm, real, imaginary;
};

// The dry substances at OPAC's wavelengths.
constexpr IndexRow kInsolubleIndex[] = {{350, 1.53, 8e-3}, {400, 1.53, 8e-3}, {450, 1.53, 8e-3},
                                        {500, 1.53, 8e-3}, {550, 1.53, 8e-3}, {600, 1.53, 8e-3},
                                        {650, 1.53, 8e-3}, {700, 1.53, 8e-3}, {750, 1.53, 8e-3},
                                        {800, 1.52, 8e-3}, {900, 1.52, 8e-3}};
constexpr IndexRow kWaterSolubleIndex[] = {
    {350, 1.53, 5e-3},   {400, 1.53, 5e-3}, {450, 1.53, 5e-3},  {500, 1.53, 5e-3},
    {550, 1.53, 6e-3},   {600, 1.53, 6e-3}, {650, 1.53, 7e-3},  {700, 1.53, 7e-3},
    {750, 1.53, 8.5e-3}, {800, 1.52, 1e-2}, {900, 1.52, 1.3e-2}};
constexpr IndexRow kSootIndex[] = {{350, 1.75, 0.465}, {400, 1.75, 0.460}, {450, 1.75, 0.455},
                                   {500, 1.75, 0.450}, {550, 1.75, 0.440}, {600, 1.75, 0.435},
                                   {650, 1.75, 0.435}, {700, 1.75, 0.430}, {750, 1.75, 0.430},
                                   {800, 1.75, 0.430}, {900, 1.75, 0.435}};
constexpr IndexRow kSeaSaltIndex[] = {
    {350, 1.51, 3.24e-7}, {400, 1.50, 3.00e-8}, {450, 1.50, 2.43e-8}, {500, 1.50, 1.55e-8},
    {550, 1.50, 1.00e-8}, {600, 1.49, 1.60e-8}, {650, 1.49, 4.24e-8}, {700, 1.49, 2.00e-7},
    {750, 1.49, 1.08e-6}, {800, 1.48, 1.95e-6}, {900, 1.48, 4.24e-5}};
constexpr IndexRow kMineralIndex[] = {{350, 1.53, 1.7e-2}, {400, 1.53, 1.3e-2}, {450, 1.53, 8.5e-3},
                                      {500, 1.53, 7.8e-3}, {550, 1.53, 5.5e-3}, {600, 1.53, 4.5e-3},
                                      {650, 1.53, 4.5e-3}, {700, 1.53, 4.0e-3}, {750, 1.53, 4.0e-3},
                                      {800, 1.53, 4.0e-3}, {900, 1.53, 4.0e-3}};
constexpr IndexRow kSulfateIndex[] = {
    {350, 1.452, 1.00e-8}, {400, 1.440, 1.00e-8}, {450, 1.432, 1.00e-8}, {500, 1.431, 1.00e-8},
    {550, 1.430, 1.00e-8}, {600, 1.429, 1.47e-8}, {650, 1.429, 1.67e-8}, {700, 1.428, 2.05e-8},
    {750, 1.427, 7.17e-8}, {800, 1.426, 8.63e-8}, {900, 1.425, 2.55e-7}};

// Hale & Querry 1973 (Appl. Opt. 12, 555), 25 C.
constexpr IndexRow kWaterIndex[] = {
    {350, 1.343, 6.50e-9}, {400, 1.339, 1.86e-9}, {450, 1.337, 1.02e-9}, {500, 1.335, 1.00e-9},
    {550, 1.333, 1.96e-9}, {600, 1.332, 1.09e-8}, {650, 1.331, 1.64e-8}, {700, 1.331, 3.35e-8},
    {750, 1.330, 1.56e-7}, {800, 1.329, 1.25e-7}, {900, 1.328, 4.86e-7}};

struct ComponentFacts {
    std::string_view name;
    std::span<const IndexRow> index;
    double deviation = 1;
    HumidRadii mode_radius_um{};
    double smallest_um = 0, largest_um = 0;  // dry
};

// Table 1c; mode radii with humidity from the heads of OPAC's files. In the order of the
// enumerators.
constexpr std::array kComponents = {
    ComponentFacts{"insoluble", kInsolubleIndex, 2.51, same_when_humid(0.471), 0.005, 20},
    ComponentFacts{"water_soluble",
                   kWaterSolubleIndex,
                   2.24,
                   {0.0212, 0.0262, 0.0285, 0.0306, 0.0348, 0.0399, 0.0476, 0.0534},
                   0.005,
                   20},
    ComponentFacts{"soot", kSootIndex, 2.00, same_when_humid(0.0118), 0.005, 20},
    ComponentFacts{"sea_salt_accumulation",
                   kSeaSaltIndex,
                   2.03,
                   {0.209, 0.336, 0.378, 0.416, 0.497, 0.605, 0.801, 0.995},
                   0.005,
                   20},
    ComponentFacts{"sea_salt_coarse",
                   kSeaSaltIndex,
                   2.03,
                   {1.75, 2.82, 3.17, 3.49, 4.18, 5.11, 6.84, 8.59},
                   0.005,
                   60},
    ComponentFacts{"mineral_nucleation", kMineralIndex, 1.95, same_when_humid(0.07), 0.005, 20},
    ComponentFacts{"mineral_accumulation", kMineralIndex, 2.00, same_when_humid(0.39), 0.005, 20},
    ComponentFacts{"mineral_coarse", kMineralIndex, 2.15, same_when_humid(1.90), 0.005, 60},
    ComponentFacts{"mineral_transported", kMineralIndex, 2.20, same_when_humid(0.50), 0.02, 5},
    ComponentFacts{"sulfate_droplets",
                   kSulfateIndex,
                   2.03,
                   {0.0695, 0.0983, 0.109, 0.118, 0.135, 0.158, 0.195, 0.231},
                   0.005,
                   20}};

constexpr double per_cubic_centimeter(double number) { return number * 1e6; }

constexpr MixturePart mixture_part(AerosolComponent component, double per_cm3) {
    return {component, {per_cubic_centimeter(per_cm3)}};
}

using enum AerosolComponent;

// Table 4.
constexpr MixturePart kContinentalClean[] = {mixture_part(water_soluble, 2600),
                                             mixture_part(insoluble, 0.15)};
constexpr MixturePart kContinentalAverage[] = {
    mixture_part(water_soluble, 7000), mixture_part(insoluble, 0.4), mixture_part(soot, 8300)};
constexpr MixturePart kContinentalPolluted[] = {
    mixture_part(water_soluble, 15700), mixture_part(insoluble, 0.6), mixture_part(soot, 34300)};
constexpr MixturePart kUrban[] = {mixture_part(water_soluble, 28000), mixture_part(insoluble, 1.5),
                                  mixture_part(soot, 130000)};
constexpr MixturePart kDesert[] = {
    mixture_part(water_soluble, 2000), mixture_part(mineral_nucleation, 269.5),
    mixture_part(mineral_accumulation, 30.5), mixture_part(mineral_coarse, 0.142)};
constexpr MixturePart kMaritimeClean[] = {mixture_part(water_soluble, 1500),
                                          mixture_part(sea_salt_accumulation, 20),
                                          mixture_part(sea_salt_coarse, 3.2e-3)};
constexpr MixturePart kMaritimePolluted[] = {
    mixture_part(water_soluble, 3800), mixture_part(sea_salt_accumulation, 20),
    mixture_part(sea_salt_coarse, 3.2e-3), mixture_part(soot, 5180)};
constexpr MixturePart kMaritimeTropical[] = {mixture_part(water_soluble, 590),
                                             mixture_part(sea_salt_accumulation, 10),
                                             mixture_part(sea_salt_coarse, 1.3e-3)};
constexpr MixturePart kArctic[] = {mixture_part(water_soluble, 1300), mixture_part(insoluble, 0.01),
                                   mixture_part(sea_salt_accumulation, 1.9),
                                   mixture_part(soot, 5300)};
constexpr MixturePart kAntarctic[] = {mixture_part(sulfate_droplets, 42.9),
                                      mixture_part(sea_salt_accumulation, 0.047),
                                      mixture_part(mineral_transported, 0.0053)};

// In the order of the enumerators.
constexpr std::array<std::span<const MixturePart>, 10> kMixtures = {
    kContinentalClean, kContinentalAverage, kContinentalPolluted, kUrban,  kDesert,
    kMaritimeClean,    kMaritimePolluted,   kMaritimeTropical,    kArctic, kAntarctic};

const ComponentFacts& facts_of(AerosolComponent component) {
    return kComponents[static_cast<std::size_t>(component)];
}

RefractiveIndex index_at(std::span<const IndexRow> rows, Length wavelength) {
    const double nm = wavelength.meters * 1e9;
    return {interpolate(rows, &IndexRow::nm, &IndexRow::real, nm),
            interpolate(rows, &IndexRow::nm, &IndexRow::imaginary, nm)};
}

double mode_radius_um(const ComponentFacts& component, double relative_humidity_percent) {
    assert(relative_humidity_percent >= 0 && relative_humidity_percent <= 99);
    const auto above =
        std::upper_bound(kTabulatedHumidities_percent.begin(),
                         kTabulatedHumidities_percent.end() - 1, relative_humidity_percent);
    const auto high = static_cast<std::size_t>(above - kTabulatedHumidities_percent.begin());
    const double first = kTabulatedHumidities_percent[high - 1],
                 second = kTabulatedHumidities_percent[high];
    const double fraction = (relative_humidity_percent - first) / (second - first);
    const double below_um = component.mode_radius_um[high - 1];
    return below_um + (component.mode_radius_um[high] - below_um) * fraction;
}

}  // namespace

std::span<const AerosolComponent> all_aerosol_components() {
    static constexpr auto kAll = [] {
        std::array<AerosolComponent, kComponents.size()> all{};
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<AerosolComponent>(i);
        return all;
    }();
    return kAll;
}

std::string_view name_of(AerosolComponent component) { return facts_of(component).name; }

LogNormalRadii radii_of(AerosolComponent component, double relative_humidity_percent) {
    const ComponentFacts& facts = facts_of(component);
    const double mode_um = mode_radius_um(facts, relative_humidity_percent);
    const double growth = mode_um / facts.mode_radius_um.front();
    return {{mode_um * 1e-6},
            facts.deviation,
            {facts.smallest_um * growth * 1e-6},
            {facts.largest_um * growth * 1e-6}};
}

double water_share(AerosolComponent component, double relative_humidity_percent) {
    const ComponentFacts& facts = facts_of(component);
    const double dry_part =
        facts.mode_radius_um.front() / mode_radius_um(facts, relative_humidity_percent);
    return 1 - dry_part * dry_part * dry_part;
}

WavelengthRange range_of(AerosolComponent component) {
    const auto rows = facts_of(component).index;
    return {{rows.front().nm / 1e9}, {rows.back().nm / 1e9}};
}

std::vector<Length> tabulated_wavelengths(AerosolComponent component) {
    return mapped<Length>(facts_of(component).index,
                          [&](const IndexRow& row) { return Length{row.nm / 1e9}; });
}

RefractiveIndex refractive_index_of(AerosolComponent component, Length wavelength,
                                    double relative_humidity_percent) {
    const RefractiveIndex dry = index_at(facts_of(component).index, wavelength);
    const RefractiveIndex water = water_index(wavelength);
    const double share = water_share(component, relative_humidity_percent);
    return {dry.real + (water.real - dry.real) * share,
            dry.imaginary + (water.imaginary - dry.imaginary) * share};
}

RefractiveIndex water_index(Length wavelength) { return index_at(kWaterIndex, wavelength); }

std::span<const MixturePart> parts_of(AerosolMixture mixture) {
    return kMixtures[static_cast<std::size_t>(mixture)];
}

}  // namespace skybake::config
