// The text by which a later run finds fitted colours.
#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <type_traits>

#include "bakers/light/sky_colors.h"
#include "config/sections/layer.h"

namespace skybake {
namespace {

// Structs name all their members: none is compiled until one that is added is named, too.
class KeyText {
  public:
    template <class... Values>
    void add(const Values&... values) {
        (put(values), ...);
    }
    const std::string& text() const { return text_; }

  private:
    void put(double number) { fmt::format_to(std::back_inserter(text_), "{} ", number); }
    // With its length, so that it cannot be taken for what follows.
    void put(const std::string& word) {
        fmt::format_to(std::back_inserter(text_), "{} {} ", word.size(), word);
    }
    template <class Word>
    requires std::is_enum_v<Word>
    void put(Word word) { put(static_cast<double>(word)); }
    template <class Value>
    void put(const std::optional<Value>& value) {
        put(value ? 1.0 : 0.0);
        if (value) add(*value);
    }
    template <class Value>
    void put(const std::vector<Value>& values) {
        put(static_cast<double>(values.size()));
        for (const Value& value : values) add(value);
    }
    template <class Quantity>
    requires std::is_class_v<Quantity>
    void put(const Quantity& quantity) {
        const auto& [number] = quantity;
        add(number);
    }

    void put(const config::SpectrumPoint& point) { put_pair(point); }
    void put(const config::DensityPoint& point) { put_pair(point); }
    void put(const config::GasAmount& amount) { put_pair(amount); }
    void put(const config::SphereKind& kind) { put_pair(kind); }
    template <class Pair>
    void put_pair(const Pair& pair) {
        const auto& [first, second] = pair;
        add(first, second);
    }
    void put(const config::IndexPoint& point) {
        const auto& [wavelength, real, imaginary] = point;
        add(wavelength, real, imaginary);
    }
    void put(const config::AerosolLaw& law) {
        const auto& [depth, extinction, exponent, albedo] = law;
        add(depth, extinction, exponent, albedo);
    }
    void put(const config::Color& color) {
        const auto& [space, observer, sun, white] = color;
        add(space, observer, sun, white);
    }
    void put(const config::Particles& spheres) {
        const auto& [name, material, real, imaginary, indices, sizes, radius, deviation, effective,
                     variance, alpha, gamma, smallest, largest] = spheres;
        add(name, material, real, imaginary, indices, sizes, radius, deviation, effective, variance,
            alpha, gamma, smallest, largest);
    }
    void put(const config::LayerParticles& particles) {
        const auto& [kinds, depth, extinction, wavelengths, step] = particles;
        add(kinds, depth, extinction, wavelengths, step);
    }
    void put(const config::Layer& layer) {
        const auto& [name, enabled, profile, scale, center, half, bottom, top, table, scattering,
                     extinction, phase, g, depolarization, gas, aerosol, particles] = layer;
        add(name, enabled, profile, scale, center, half, bottom, top, table, scattering, extinction,
            phase, g, depolarization, gas, aerosol, particles);
    }
    void put(const config::Atmosphere& air) {
        const auto& [ground, top, albedo, spectrum, layers] = air;
        add(ground, top, albedo, spectrum, layers);
    }

    std::string text_;
};

}  // namespace

std::string key_text(const ColorRequest& request) {
    const auto& [wavelengths, color, atmosphere] = request;
    KeyText text;
    text.add(wavelengths, color, atmosphere);
    return text.text();
}

}  // namespace skybake
