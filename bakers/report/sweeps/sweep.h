// The variants of an asset that a report compares, the measurement of their cost, and the Pareto
// fronts of cost against error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/field/table_model.h"
#include "bakers/io/files/file_io.h"
#include "bakers/report/report.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// One way to make a table. The texels depend only on model, level and size; the pixel type is
// applied afterwards.
struct Variant {
    std::string family;
    std::string name;
    std::string baseline;
    bool of_recipe = false;
    bool in_quadrature_sweep = false;
    std::array<int, 2> size{};
    config::PixelType pixel_type = config::PixelType::float32;
    std::shared_ptr<const TableModel> model;
    int level = 0;
    // The model whose reference, texel convention and error function are used for measuring. All
    // variants that represent the same values at the same coordinates share it.
    std::shared_ptr<const TableModel> truth;
};

struct Sweep {
    std::string timing;  // what the times mean
    PointCounts texels;  // the most that are compared
    PointCounts lookups;
    std::vector<Variant> variants;
};

// Returns the given size times each of the factors, for tables (2 axes) or volumes (3 axes). Each
// axis has at least 2 texels, unless the given size has 1. Sizes of more than `max_texels` texels
// and duplicates are left out.
template <std::size_t Axes>
std::vector<std::array<int, Axes>> sizes_around(
    std::array<int, Axes> size, const std::vector<std::array<double, Axes>>& factors,
    std::int64_t max_texels);

// Returns the size, halved along all axes until it has at most `max_texels` texels. `max_texels`
// must be at least 2 to the power of the number of axes.
template <std::size_t Axes>
std::array<int, Axes> size_within(std::array<int, Axes> size, std::int64_t max_texels);

// "256x64"
std::string size_text(std::span<const int> size);

// Returns the processor time of the calling thread, which does not depend on what else the machine
// does.
double thread_cpu_seconds();

// Returns the median time of each job in seconds. The jobs run in turn, in `repetitions` rounds, so
// that a machine that slows down affects all of them. If `before_each(round, job)` returns false,
// the function stops and the result is empty. repetitions >= 1.
std::vector<double> interleaved_medians(
    const std::vector<std::function<void()>>& jobs, int repetitions,
    const std::function<bool(int round, std::size_t job)>& before_each);

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

// The relative difference that was observed between medians of equal work.
inline constexpr double kTimingNoise = 0.05;

// Calls mark(row) for each row that takes part and that no other such row beats. `choice` gives a
// row's cost and error; `noise` is that of pareto_front.
void mark_front(std::vector<ReportRow>& rows,
                const std::function<bool(const ReportRow&)>& takes_part,
                const std::function<CostAndError(const ReportRow&)>& choice, double noise,
                const std::function<void(ReportRow&)>& mark);

// Marks the fronts of time that every asset has: ReportRow::on_lookup_front and on_texel_front.
// `compared` maps an RMS error to the value that is compared.
void mark_time_fronts(std::vector<ReportRow>& rows, double (*compared)(double rms));

}  // namespace skybake
