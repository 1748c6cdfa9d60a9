// Calls of printed functions: each runs in GLSL and in Metal's language, both as C++, which must agree to
// the last bit; and is noted, with its arguments and with what it must return, for the languages that run
// in a browser (tests/browser/lookups.js). SKYBAKE_CALLS names the folder of the notes: calls.json, and
// each texture as floats, four for a texel.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/lookups/lookup_trial.h"
#include "tests/lookups/metal_stdlib"
#include "tests/support/volumes.h"

namespace skybake::test {

// --- Notes --------------------------------------------------------------------------------------

class CallNotes {
  public:
    static CallNotes& of_this_run() {
        static CallNotes notes;
        return notes;
    }
    CallNotes(const CallNotes&) = delete;
    CallNotes& operator=(const CallNotes&) = delete;
    ~CallNotes() {
        if (is_wanted()) std::ofstream(folder_ / "calls.json") << calls_;
    }

    bool is_wanted() const { return !folder_.empty(); }

    void add(const char* file, const char* function, nlohmann::json arguments, int channels) {
        last_ = {{"file", file},
                 {"function", function},
                 {"arguments", std::move(arguments)},
                 {"channels", channels}};
    }
    // Sets the bounds of the last call, and notes it. A call without bounds is not noted.
    void bound_by(std::vector<double> value, const std::vector<double>& tolerance) {
        std::vector<double> high = value;
        for (std::size_t c = 0; c < value.size(); ++c) {
            value[c] -= tolerance[c];
            high[c] += tolerance[c];
        }
        bound(value, high);
    }
    void bound(const std::vector<double>& low, const std::vector<double>& high) {
        if (!is_wanted()) return;
        last_["low"] = low;
        last_["high"] = high;
        calls_.push_back(last_);
    }

    nlohmann::json texture(const Texture& texture) {
        if (known_.insert(texture.name).second) {
            std::ofstream file(folder_ / (texture.name + ".f32"), std::ios::binary);
            testing::for_each_voxel(texture.size, [&](int x, int y, int z) {
                for (const double value : fetched(texture, {x, y, z})) {
                    const auto number = static_cast<float>(value);
                    file.write(reinterpret_cast<const char*>(&number), sizeof number);
                }
            });
        }
        return {{"texture", texture.name}, {"size", texture.size}, {"repeats", texture.repeats}};
    }

  private:
    CallNotes() {
        if (const char* const folder = std::getenv("SKYBAKE_CALLS")) folder_ = folder;
    }

    std::filesystem::path folder_;
    nlohmann::json calls_ = nlohmann::json::array();
    nlohmann::json last_;
    std::set<std::string> known_;
};

inline nlohmann::json noted(float x) { return {{"type", "float"}, {"value", {x}}}; }
inline nlohmann::json noted(int x) { return {{"type", "int"}, {"value", {x}}}; }
inline nlohmann::json noted(bool x) { return {{"type", "bool"}, {"value", {x ? 1 : 0}}}; }
template <glm::length_t N>
nlohmann::json noted(const glm::vec<N, float>& v) {
    return {{"type", "vec" + std::to_string(N)}, {"value", std::vector<float>(&v.x, &v.x + N)}};
}
inline nlohmann::json noted(const Texture& texture) {
    return CallNotes::of_this_run().texture(texture);
}

// --- Calls --------------------------------------------------------------------------------------

// A texture as whatever a function takes.
struct Passed {
    const Texture& texture;
    operator gpu::sampler2D() const { return {texture}; }
    operator gpu::sampler2DArray() const { return {texture}; }
    operator gpu::sampler3D() const { return {texture}; }
    operator metal::texture2d<float>() const { return {{&texture}}; }
    operator metal::texture2d_array<float>() const { return {{&texture}}; }
    operator metal::texture3d<float>() const { return {{&texture}}; }
};
inline Passed passed(const Texture& texture) { return {texture}; }
template <class Number>
Number passed(const Number& number) {
    return number;
}

// The arguments that a function of these parameters gets, the samplers among them; `I` of those
// given are used up.
template <std::size_t I, class Given>
std::tuple<> arguments_of(const Given&, std::tuple<>*) {
    return {};
}
template <std::size_t I, class Given, class First, class... Rest>
auto arguments_of(const Given& given, std::tuple<First, Rest...>*) {
    auto* const rest = static_cast<std::tuple<Rest...>*>(nullptr);
    if constexpr (std::is_same_v<First, metal::sampler>) {
        return std::tuple_cat(std::tuple<First>(), arguments_of<I>(given, rest));
    } else {
        return std::tuple_cat(std::tuple<First>(static_cast<First>(std::get<I>(given))),
                              arguments_of<I + 1>(given, rest));
    }
}
template <class Result, class... Parameters, class... Given>
Result call(Result (*function)(Parameters...), const Given&... given) {
    return std::apply(function, arguments_of<0>(std::tuple<Given...>(given...),
                                                static_cast<std::tuple<Parameters...>*>(nullptr)));
}

// Returns a value with fewer channels as one of four.
inline gpu::vec4 widened(float value) { return {value, 0, 0, 1}; }
inline gpu::vec4 widened(const gpu::vec2& value) { return {value, 0, 1}; }
inline gpu::vec4 widened(const gpu::vec3& value) { return {value, 1}; }
inline gpu::vec4 widened(const gpu::vec4& value) { return value; }

template <class Result>
constexpr int channels_of() {
    return sizeof(Result) / sizeof(float);
}

template <class Result, class... Of, class Other, class... OfOther, class... Arguments>
Result called(const char* file, const char* name, Result (*glsl)(Of...), Other (*metal)(OfOther...),
              const Arguments&... arguments) {
    const Result value = call(glsl, passed(arguments)...);
    const gpu::vec4 other = widened(call(metal, passed(arguments)...));
    for (glm::length_t c = 0; c < 4; ++c) {
        EXPECT_TRUE(widened(value)[c] == other[c] ||
                    (std::isnan(widened(value)[c]) && std::isnan(other[c])))
            << file << ", " << name << ": " << widened(value)[c] << ", in Metal's language "
            << other[c];
    }
    CallNotes& notes = CallNotes::of_this_run();
    if (notes.is_wanted()) {
        notes.add(file, name, nlohmann::json::array({noted(arguments)...}), channels_of<Result>());
    }
    return value;
}

// Compares the last call with a probe, or with a number that another language may miss by so much.
inline void expect_probe_of_call(const gpu::vec4& found, const Probe& probe) {
    expect_probe(found, probe.value, probe.tolerance, ::testing::PrintToString(probe.at));
    CallNotes::of_this_run().bound_by(probe.value, probe.tolerance);
}
inline void expect_column_of_call(const gpu::vec4& column, double length_km, const Probe& probe) {
    expect_column(column, length_km, probe);
    const ColumnRange range = column_range(length_km, probe);
    CallNotes::of_this_run().bound(range.low, range.high);
}
inline void bound_call(double value, double tolerance) {
    CallNotes::of_this_run().bound_by({value}, {tolerance});
}
inline void expect_color_of_call(const gpu::vec3& found, const std::vector<double>& color) {
    const std::vector<double> tolerance(3, 1e-5);
    expect_probe(widened(found), color, tolerance, "color");
    CallNotes::of_this_run().bound_by(color, tolerance);
}

}  // namespace skybake::test
