#include "bakers/field/survey_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/hash.h"
#include "bakers/math/memory.h"
#include "bakers/math/parallel.h"

namespace skybake {

namespace {

using config::Diagnostic;
using config::PixelType;

// Summary of one channel's values, for one box or for all boxes so far.
struct Summary {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
    double sum = 0;
    std::array<std::int64_t, kHistogramBins> histogram{};
    long below_normal = 0;
};

struct BadValue {
    std::size_t index = 0;  // of the voxel in its box
    std::size_t channel = 0;
    float value = 0;
};

// A box on its way from a producer to the consumer.
struct Slot {
    AlignedFloats values;  // channel after channel
    std::string bytes;
    std::vector<Summary> channels;
    std::vector<VoxelPeak> peaks;
    std::optional<BadValue> bad;
};

std::optional<BadValue> first_bad(const std::vector<const float*>& channels, std::size_t count,
                                  PixelType type) {
    const PixelRange range = range_of(type);
    std::optional<BadValue> bad;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        // First checks whether there is a bad value at all, because a typical box has none.
        int outside = 0;
        for (std::size_t i = 0; i < count; ++i) outside |= range.contains(channels[c][i]) ? 0 : 1;
        if (outside == 0) continue;
        for (std::size_t i = 0; i < count && (!bad || i < bad->index); ++i) {
            if (!range.contains(channels[c][i])) bad = BadValue{i, c, channels[c][i]};
        }
    }
    return bad;
}

// Counts values below the normal range. The values are not yet rounded.
int count_below_normal(const float* values, std::size_t count, PixelType type) {
    const auto smallest = static_cast<float>(smallest_normal(type));
    int below = 0;
    for (std::size_t i = 0; i < count; ++i) {
        below +=
            static_cast<int>(values[i] != 0) & static_cast<int>(std::fabs(values[i]) < smallest);
    }
    return below;
}

// Whether all values are +0. A -0 does not count, because it is stored as -0.
bool is_zero(const float* values, std::size_t count) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) bits |= std::bit_cast<std::uint32_t>(values[i]);
    return bits == 0;
}

// The extremes and the sum of one channel, in eight lanes, so that no addition waits for the one
// before. The order of additions is fixed: value i of a box belongs to lane i mod 8.
class LaneSummary {
  public:
    void add(const float* values, std::size_t count) {
        std::size_t i = 0;
        for (; i + kLanes <= count; i += kLanes) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) add(lane, values[i + lane]);
        }
        for (std::size_t lane = 0; i < count; ++i, ++lane) add(lane, values[i]);
    }

    // Has the effect of adding zeros: the sums do not change.
    void add_zeros() {
        least_[0] = std::min(least_[0], 0.0f);
        most_[0] = std::max(most_[0], 0.0f);
    }

    void finish(Summary& summary) const {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            summary.min = std::min(summary.min, double{least_[lane]});
            summary.max = std::max(summary.max, double{most_[lane]});
            summary.sum += sums_[lane];
        }
    }

  private:
    static constexpr std::size_t kLanes = 8;

    void add(std::size_t lane, float value) {
        least_[lane] = value < least_[lane] ? value : least_[lane];
        most_[lane] = value > most_[lane] ? value : most_[lane];
        sums_[lane] += double{value};
    }

    static constexpr std::array<float, kLanes> all(float value) {
        std::array<float, kLanes> lanes;
        lanes.fill(value);
        return lanes;
    }

    std::array<float, kLanes> least_ = all(std::numeric_limits<float>::infinity());
    std::array<float, kLanes> most_ = all(-std::numeric_limits<float>::infinity());
    std::array<double, kLanes> sums_{};
};

// Returns the bin of a value; values outside the range go to the bin past the last.
std::size_t bin_of(double value, std::array<double, 2> range, double scale) {
    const bool inside = value >= range[0] && value <= range[1];
    const int bin =
        std::min(static_cast<int>((inside ? value - range[0] : 0.0) * scale), kHistogramBins - 1);
    return static_cast<std::size_t>(inside ? bin : kHistogramBins);
}

// The histogram of one channel. Each bin has two counters: neighbouring values are often alike, and
// the second increment need not wait for the first.
class Histogram {
  public:
    explicit Histogram(std::array<double, 2> range)
        : range_(range), scale_(kHistogramBins / (range[1] - range[0])) {}

    void add(const float* values, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            ++counts_[i % 2][bin_of(double{values[i]}, range_, scale_)];
        }
    }

    void add_zeros(std::size_t count) {
        counts_[0][bin_of(0, range_, scale_)] += static_cast<int>(count);
    }

    void finish(Summary& summary) const {
        for (std::size_t bin = 0; bin < kHistogramBins; ++bin) {
            summary.histogram[bin] += counts_[0][bin] + counts_[1][bin];
        }
    }

  private:
    std::array<double, 2> range_;
    double scale_;
    std::array<std::array<int, kHistogramBins + 1>, 2> counts_{};
};

// Summarises the values of one channel of a box and stores them, piece by piece, while a piece is
// in the L1 cache. Rounds `values`. Most pieces of a cloud's box are empty and cost only one check.
Summary summarize(float* values, std::size_t count, std::array<double, 2> range, PixelType type,
                  char* stored) {
    constexpr std::size_t kPiece = 512;
    const auto width = static_cast<std::size_t>(bytes_per_value(type));
    Summary summary;
    LaneSummary lanes;
    Histogram histogram(range);
    for (std::size_t i = 0; i < count; i += kPiece) {
        const std::size_t piece = std::min(kPiece, count - i);
        float* const from = values + i;
        if (is_zero(from, piece)) {
            std::memset(stored + i * width, 0, piece * width);
            lanes.add_zeros();
            histogram.add_zeros(piece);
            continue;
        }
        summary.below_normal += count_below_normal(from, piece, type);
        store_values(from, piece, type, stored + i * width);
        load_values(stored + i * width, piece, type, from);
        lanes.add(from, piece);
        histogram.add(from, piece);
    }
    lanes.finish(summary);
    histogram.finish(summary);
    return summary;
}

void add(const Summary& part, Summary& whole) {
    whole.min = std::min(whole.min, part.min);
    whole.max = std::max(whole.max, part.max);
    whole.sum += part.sum;
    whole.below_normal += part.below_normal;
    for (std::size_t i = 0; i < part.histogram.size(); ++i) {
        whole.histogram[i] += part.histogram[i];
    }
}

// Finds the largest value in eight lanes, so that no comparison waits for the one before.
float largest_of(const float* values, std::size_t count) {
    constexpr std::size_t kLanes = 8;
    std::array<float, kLanes> most{};
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            most[lane] = values[i + lane] > most[lane] ? values[i + lane] : most[lane];
        }
    }
    float largest = *std::max_element(most.begin(), most.end());
    for (; i < count; ++i) largest = std::max(largest, values[i]);
    return largest;
}

// Adds the first of the largest voxels of each eighth of a box, in one channel. An eighth in which
// no value is above 0 adds nothing.
void add_box_peaks(const float* values, const VoxelBox& box, int channel,
                   std::vector<VoxelPeak>& peaks) {
    constexpr std::size_t kParts = 8;
    const auto count = static_cast<std::size_t>(box.count());
    const auto width = static_cast<std::size_t>(box.size[0]);
    const auto height = static_cast<std::size_t>(box.size[1]);
    for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t first = part * count / kParts;
        const std::size_t last = (part + 1) * count / kParts;
        const float largest = largest_of(values + first, last - first);
        if (largest <= 0) continue;
        const auto at =
            static_cast<std::size_t>(std::find(values + first, values + last, largest) - values);
        peaks.push_back({{box.origin[0] + static_cast<int>(at % width),
                          box.origin[1] + static_cast<int>(at / width % height),
                          box.origin[2] + static_cast<int>(at / width / height)},
                         channel,
                         largest});
    }
}

ValueStatistics statistics_of(const Summary& summary, std::array<double, 2> range, double count) {
    ValueStatistics statistics;
    statistics.min = summary.min + 0.0;  // a zero without its sign
    statistics.max = summary.max + 0.0;
    statistics.mean = summary.sum / count + 0.0;
    statistics.histogram_range = range;
    statistics.histogram.assign(summary.histogram.begin(), summary.histogram.end());
    return statistics;
}

class Survey {
  public:
    Survey(const Baked& volume, int level,
           const std::vector<std::array<double, 2>>& histogram_ranges, const BakeOptions& options)
        : volume_(volume),
          level_(volume.levels[static_cast<std::size_t>(level)]),
          number_(level),
          ranges_(histogram_ranges),
          options_(options),
          boxes_(level_.size, static_cast<int>(volume.channel_names.size())),
          whole_(volume.channel_names.size()) {}

    // Returns false after an interruption or a bad value.
    bool run() {
        slots_.resize(static_cast<std::size_t>(box_slots(options_.threads)));
        bool finished = true;
        ordered_pipeline(
            boxes_.count(), options_.threads, static_cast<int>(slots_.size()),
            [&](int i, int slot) { look_at(i, slots_[static_cast<std::size_t>(slot)]); },
            [&](int i, int slot) {
                finished = take(i, slots_[static_cast<std::size_t>(slot)]);
                return finished;
            });
        return finished;
    }

    const std::optional<Diagnostic>& problem() const { return problem_; }

    void fill(Level& level, RangeCounts& range) const {
        const double count = static_cast<double>(level_.size[0]) * level_.size[1] * level_.size[2];
        level.statistics.clear();
        for (std::size_t c = 0; c < whole_.size(); ++c) {
            level.statistics.push_back(statistics_of(whole_[c], ranges_[c], count));
            range.below_normal += whole_[c].below_normal;
        }
        level.content_hash = hasher_.hex();
        level.peaks = peaks_;
    }

  private:
    void look_at(int index, Slot& slot) const {
        if (options_.cancelled()) return;
        const VoxelBox box = boxes_[index];
        const auto count = static_cast<std::size_t>(box.count());
        const std::size_t channels = whole_.size();
        slot.values.resize(count * channels);
        std::vector<float*> planes;
        for (std::size_t c = 0; c < channels; ++c) planes.push_back(&slot.values[c * count]);
        level_.voxels->fill(box, planes);
        const std::vector<const float*> values(planes.begin(), planes.end());
        slot.bad = first_bad(values, count, volume_.pixel_type);
        if (slot.bad) return;
        slot.channels.clear();
        const auto width = static_cast<std::size_t>(bytes_per_value(volume_.pixel_type));
        slot.bytes.resize(count * channels * width);
        for (std::size_t c = 0; c < channels; ++c) {
            slot.channels.push_back(summarize(planes[c], count, ranges_[c], volume_.pixel_type,
                                              slot.bytes.data() + c * count * width));
        }
        slot.peaks.clear();
        for (std::size_t c = 0; c < channels; ++c) {
            add_box_peaks(planes[c], box, static_cast<int>(c), slot.peaks);
        }
        // Several channels are stored interleaved.
        if (channels > 1) store_voxels(values, count, volume_.pixel_type, slot.bytes.data());
    }

    bool take(int index, const Slot& slot) {
        if (options_.cancelled()) return false;
        if (slot.bad) {
            problem_ = diagnostic(boxes_[index], *slot.bad);
            return false;
        }
        for (std::size_t c = 0; c < whole_.size(); ++c) add(slot.channels[c], whole_[c]);
        peaks_.insert(peaks_.end(), slot.peaks.begin(), slot.peaks.end());
        hasher_.update(slot.bytes);
        if (options_.progress != nullptr) {
            options_.progress->advance("voxels", (index + 1.0) / boxes_.count());
        }
        return true;
    }

    Diagnostic diagnostic(const VoxelBox& box, const BadValue& bad) const {
        const auto width = static_cast<std::size_t>(box.size[0]);
        const auto height = static_cast<std::size_t>(box.size[1]);
        const std::string level = number_ == 0 ? "" : fmt::format(" of level {}", number_);
        const std::string place = fmt::format(
            "`{}`: the value at voxel ({}, {}, {}){}, channel {},", volume_.name, bad.index % width,
            bad.index / width % height + static_cast<std::size_t>(box.origin[1]),
            bad.index / width / height + static_cast<std::size_t>(box.origin[2]), level,
            volume_.channel_names[bad.channel]);
        Diagnostic result;
        result.code = std::isfinite(bad.value) ? "E0402" : "E0401";
        result.message = std::isfinite(bad.value)
                             ? fmt::format("{} is {}, outside {}", place, bad.value,
                                           range_text(volume_.pixel_type))
                             : fmt::format("{} is not finite", place);
        if (std::isfinite(bad.value)) {
            const bool is_noise = volume_.kind == "noise_volume";
            const bool is_half = volume_.pixel_type == PixelType::half;
            result.label = fmt::format(
                "{}bake it as {}",
                is_noise
                    ? fmt::format(
                          "bring it into {} with the channel's remap, smoothstep or clamp, or ",
                          range_text(volume_.pixel_type))
                    : "",
                is_half ? "float" : "half or float");
        }
        return result;
    }

    const Baked& volume_;
    const Level& level_;
    const int number_;
    const std::vector<std::array<double, 2>>& ranges_;
    const BakeOptions& options_;
    const BoxSequence boxes_;
    std::vector<Slot> slots_;
    std::vector<Summary> whole_;
    std::vector<VoxelPeak> peaks_;
    Hasher hasher_;
    std::optional<Diagnostic> problem_;
};

}  // namespace

std::vector<Diagnostic> survey_level(Baked& volume, int level,
                                     const std::vector<std::array<double, 2>>& histogram_ranges,
                                     const BakeOptions& options) {
    Survey survey(volume, level, histogram_ranges, options);
    if (!survey.run()) {
        if (survey.problem()) return {*survey.problem()};
        return {};
    }
    survey.fill(volume.levels[static_cast<std::size_t>(level)], volume.range);
    return {};
}

}  // namespace skybake
