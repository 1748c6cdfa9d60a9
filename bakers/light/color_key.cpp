// The text by which a later run finds fitted colours.
#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <type_traits>

#include "bakers/light/sky_colors.h"
#include "config/sections/layer.h"

namespace skybake {
namespace {

template <class One, class... Others>
constexpr bool kIsOneOf = (std::is_same_v<One, Others> || ...);

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
    template <class Value>
    void put(const std::optional<Value>& value) {
        put(value ? 1.0 : 0.0);
        if (value) put(*value);
    }
    template <class Value>
    void put(const std::vector<Value>& values) {
        put(static_cast<double>(values.size()));
        for (const Value& value : values) put(value);
    }
    // Structs have so many members: with one more this is not compiled.
    template <class Value>
    void put(const Value& value) {
        using namespace config;
        if constexpr (!std::is_class_v<Value>) {
            put(static_cast<double>(value));  // a word or a flag
        } else if constexpr (kIsOneOf<Value, Length, InverseLength, NumberDensity, ColumnDensity>) {
            const auto& [a] = value;
            add(a);
        } else if constexpr (kIsOneOf<Value, SpectrumPoint, DensityPoint, GasAmount, SphereKind>) {
            const auto& [a, b] = value;
            add(a, b);
        } else if constexpr (kIsOneOf<Value, IndexPoint, ColorRequest>) {
            const auto& [a, b, c] = value;
            add(a, b, c);
        } else if constexpr (kIsOneOf<Value, Color, AerosolLaw>) {
            const auto& [a, b, c, d] = value;
            add(a, b, c, d);
        } else if constexpr (kIsOneOf<Value, Atmosphere, LayerParticles>) {
            const auto& [a, b, c, d, e] = value;
            add(a, b, c, d, e);
        } else if constexpr (kIsOneOf<Value, Particles>) {
            const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value;
            add(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
        } else {
            const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = value;  // a layer
            add(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
        }
    }

    std::string text_;
};

}  // namespace

std::string key_text(const ColorRequest& request) {
    KeyText text;
    text.add(request);
    return text.text();
}

}  // namespace skybake
