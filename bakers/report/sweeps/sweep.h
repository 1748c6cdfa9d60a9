// The variants of an asset that a report compares.
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
#include "config/sections/files.h"

namespace skybake {

// One way to make a table. Texels are a function of model, level and size; the pixel type comes
// after.
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
    // The model whose reference, texel convention and error are the measure; shared by all variants
    // that mean the same values at the same coordinates.
    std::shared_ptr<const TableModel> truth;
};

struct Sweep {
    std::string timing;  // what the times are
    PointCounts texels;  // at most so many are compared
    PointCounts lookups;
    std::vector<Variant> variants;
};

// Sizes of tables (2 axes) and volumes (3) that are the given one times the factors, at least 2
// texels an axis unless the size itself has 1, without those of more than `max_texels` and without
// duplicates.
template <std::size_t Axes>
std::vector<std::array<int, Axes>> sizes_around(
    std::array<int, Axes> size, const std::vector<std::array<double, Axes>>& factors,
    std::int64_t max_texels);

// The size halved on all axes until it has no more than `max_texels` (at least 2 to the number of
// axes).
template <std::size_t Axes>
std::array<int, Axes> size_within(std::array<int, Axes> size, std::int64_t max_texels);

// "256x64"
std::string size_text(std::span<const int> size);

// What work costs: processor time of the calling thread, whatever else the machine does meanwhile,
// and bytes that are written to memory.

// Of the calling thread.
double thread_cpu_seconds();

// The median time of each job in seconds. The jobs are run in turn, `repetitions` times round, so
// that a machine that slows down slows them all; `before_each(round, job)` returns false to stop,
// and then the result is empty. repetitions >= 1.
std::vector<double> interleaved_medians(
    const std::vector<std::function<void()>>& jobs, int repetitions,
    const std::function<bool(int round, std::size_t job)>& before_each);

// A file in memory that writers find under a path: what it takes to store something, without the
// disk's share in it and without anything left behind.
class MemoryFile {
  public:
    // Where the system gives none, whoever opens the path is told that it cannot be.
    MemoryFile();
    std::filesystem::path path() const;
    std::uint64_t bytes() const;

  private:
    FileDescriptor file_;
};

// Which of several choices are worth their price, and which rows of a report.
struct CostAndError {
    double cost = 0;
    double error = 0;
};

// True for each choice that no other beats: by a smaller error at no greater cost, or by a smaller
// cost at the same error. Costs that are apart by no more than the share `noise` count as the same
// where errors differ. A choice that is not finite is never on the front.
std::vector<bool> pareto_front(const std::vector<CostAndError>& choices, double noise = 0);

// Medians of equal work have been seen to differ by so much.
inline constexpr double kTimingNoise = 0.05;

// Calls mark(row) for each row that takes part and that no other of them beats by `choice`. Costs
// that are apart by no more than the share `noise` count as the same, as in pareto_front.
void mark_front(std::vector<ReportRow>& rows,
                const std::function<bool(const ReportRow&)>& takes_part,
                const std::function<CostAndError(const ReportRow&)>& choice, double noise,
                const std::function<void(ReportRow&)>& mark);

// The fronts of time that every asset has: ReportRow::on_lookup_front and on_texel_front.
// `compared` is what an RMS error counts as.
void mark_time_fronts(std::vector<ReportRow>& rows, double (*compared)(double rms));

}  // namespace skybake
