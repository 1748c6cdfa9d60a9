// Measures what variants cost: processor time, the bytes of files, and who is on the front.
//
// Variants of a recipe: the same recipe with some keys changed. A report measures them, and so does
// whoever compares ways to make an asset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/plot/chart.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Reads a recipe with more settings than those that its user gave, "bake.sky.size=[192, 108]".
using LoadRecipe = std::function<Outcome<Recipe>(std::span<const std::string> settings)>;

// Returns a TOML value as tables show it: "256x64" for "[256, 64]", "half" for a text in quotes.
std::string plain_value(std::string_view toml);

struct Variant {
    std::string family;    // the key that differs: "pixel_type"; of the recipe itself "this recipe"
    std::string name;      // its value: "half"
    std::string baseline;  // whose published method it is; or empty
    std::vector<std::string> settings;
};

// Returns the recipe itself and its variants, each of which differs in one of the keys that the
// asset's baker names (Baker::variants): half and double a size or a number, every other choice.
std::vector<Variant> variants_of(const Recipe& recipe, const Bake& bake);

// "256x64"
std::string size_text(std::span<const int> size);

// Returns the processor time of the calling thread, which does not depend on what else the machine
// does.
double thread_cpu_seconds();

// A file in memory with a path that writers can open. It measures writing without the disk and
// leaves nothing behind.
class MemoryFile {
  public:
    // If the system does not provide such a file, opening its path fails.
    MemoryFile();
    std::filesystem::path path() const;
    std::uint64_t bytes() const;

  private:
    FileDescriptor file_;
};

// The cost and the error of a choice, for Pareto fronts.
struct CostAndError {
    double cost = 0;
    double error = 0;
};

// Returns true for each choice that no other choice beats. A choice beats another by a smaller
// error at no greater cost, or by a smaller cost at the same error. If errors differ, costs within
// the relative difference `noise` count as equal. A choice that is not finite is never on the
// front.
std::vector<bool> pareto_front(const std::vector<CostAndError>& choices, double noise = 0);

// Marks the points of a chart that are on the front of its own two figures.
void mark_front(std::vector<ChartPoint>& points, double noise = 0);

// The relative difference that was observed between medians of equal work.
inline constexpr double kTimingNoise = 0.05;

}  // namespace skybake
