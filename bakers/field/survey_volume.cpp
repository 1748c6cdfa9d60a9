#include "bakers/field/survey_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/take_boxes.h"
#include "bakers/field/value_kernel.h"
#include "bakers/field/voxel_index.h"
#include "bakers/math/hash.h"
#include "bakers/math/memory.h"

namespace skybake {
namespace {

// Summary of one channel's values, for one box or for all boxes so far.
struct Summary {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
    double sum = 0;
    std::array<std::int64_t, kHistogramBins> histogram{};
    long below_normal = 0;
    std::int64_t filled = 0;          // values that are not 0
    std::vector<std::size_t> chosen;  // places in the box of every n-th of them
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
    std::vector<char> covered;  // columns of the box with a value above that of ColumnCount
    std::optional<BadValue> bad;
};

// The first voxel, and the first of its channels, whose value the type cannot hold.
BadValue first_bad(const std::vector<float*>& channels, PixelType type) {
    const PixelRange range = range_of(type);
    for (std::size_t i = 0;; ++i) {
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (!range.contains(channels[c][i])) return {i, c, channels[c][i]};
        }
    }
}

void finish(const LaneSummary& lanes, Summary& summary) {
    for (std::size_t lane = 0; lane < LaneSummary::kLanes; ++lane) {
        summary.min = std::min(summary.min, lanes.least[lane]);
        summary.max = std::max(summary.max, lanes.most[lane]);
        summary.sum += lanes.sums[lane];
    }
}

// The histogram of one channel; the bin past the last has the values outside the range. Each bin has
// four counters: neighbouring values are often alike, and an increment need not wait for the one
// before.
class Histogram {
  public:
    explicit Histogram(std::array<double, 2> range)
        : range_(range), scale_(kHistogramBins / (range[1] - range[0])) {}

    void add(const float* values, std::size_t count) {
        std::array<std::int32_t, kPiece> bins;
        for (std::size_t i = 0; i < count; i += kPiece) {
            const std::size_t piece = std::min(kPiece, count - i);
            find_bins(values + i, piece, range_, scale_, kHistogramBins, bins.data());
            for (std::size_t k = 0; k < piece; ++k) {
                ++counts_[k % kCounters][static_cast<std::size_t>(bins[k])];
            }
        }
    }

    void add_zeros(std::size_t count) {
        constexpr float kZero = 0;
        std::int32_t bin = 0;
        find_bins(&kZero, 1, range_, scale_, kHistogramBins, &bin);
        counts_[0][static_cast<std::size_t>(bin)] += static_cast<int>(count);
    }

    void finish(Summary& summary) const {
        for (const auto& counts : counts_) {
            for (std::size_t bin = 0; bin < kHistogramBins; ++bin) {
                summary.histogram[bin] += counts[bin];
            }
        }
    }

  private:
    static constexpr std::size_t kPiece = 256;
    static constexpr std::size_t kCounters = 4;

    std::array<double, 2> range_;
    double scale_;
    std::array<std::array<int, kHistogramBins + 1>, kCounters> counts_{};
};

// Values up to `end` that are all +0, or of which each piece has others.
struct Stretch {
    std::size_t end = 0;
    bool zeros = false;
};

// The stretch from value `first` on. Others than zeros are few enough for the first cache.
Stretch stretch_from(const float* values, std::size_t first, std::size_t count) {
    constexpr std::size_t kPiece = 64;
    constexpr std::size_t kMostOthers = 1024;
    const auto end_of = [&](std::size_t piece) { return std::min(piece + kPiece, count); };
    const auto is_zero = [&](std::size_t piece) {
        return are_zeros(values + piece, end_of(piece) - piece);
    };
    Stretch stretch{end_of(first), is_zero(first)};
    while (stretch.end < count && is_zero(stretch.end) == stretch.zeros &&
           (stretch.zeros || stretch.end - first < kMostOthers)) {
        stretch.end = end_of(stretch.end);
    }
    return stretch;
}

// Counts the values that are not 0, of which the first is at `first` in its box, and chooses every `step`-th.
void add_filled(const float* values, std::size_t count, std::size_t first, std::int64_t step,
                Summary& summary) {
    constexpr std::size_t kPiece = 128;
    for (std::size_t begin = 0; begin < count; begin += kPiece) {
        const std::size_t end = std::min(begin + kPiece, count);
        const std::int64_t more =
            count_below(values + begin, end - begin, std::numeric_limits<float>::infinity());
        std::int64_t number = summary.filled + step / 2;
        summary.filled += more;
        if ((number + more) / step == number / step) continue;
        for (std::size_t i = begin; i < end; ++i) {
            if (values[i] != 0 && ++number % step == 0) summary.chosen.push_back(first + i);
        }
    }
}

// Summarises the values of one channel of a box and stores them. Rounds `values`. Most of a cloud's
// box is empty and costs only one check. Chooses every `step`-th filled value, or none if `step` is 0. Returns
// nothing if the type cannot hold some value, which is left as it is.
std::optional<Summary> summarize(float* values, std::size_t count, std::array<double, 2> range,
                                 PixelType type, std::int64_t step, char* stored) {
    const auto width = bytes_per_value(type);
    const PixelRange bounds = range_of(type);
    const auto normal = static_cast<float>(smallest_normal(type));
    Summary summary;
    LaneSummary lanes;
    Histogram histogram(range);
    Stretch stretch;
    for (std::size_t i = 0; i < count; i = stretch.end) {
        stretch = stretch_from(values, i, count);
        const std::size_t length = stretch.end - i;
        float* const from = values + i;
        char* const to = stored + i * width;
        if (stretch.zeros) {
            std::memset(to, 0, length * width);
            constexpr std::array<float, LaneSummary::kLanes> kZeros{};  // change no sum
            add_values(kZeros.data(), std::min(length, kZeros.size()), lanes);
            histogram.add_zeros(length);
            continue;
        }
        if (!are_within(from, length, bounds.low, bounds.high)) return std::nullopt;
        summary.below_normal += count_below(from, length, normal);
        store_values(from, length, type, to);
        load_values(to, length, type, from);
        add_values(from, length, lanes);
        histogram.add(from, length);
        if (step > 0) add_filled(from, length, i, step, summary);
    }
    finish(lanes, summary);
    histogram.finish(summary);
    return summary;
}

void add(const Summary& part, Summary& whole) {
    whole.min = std::min(whole.min, part.min);
    whole.max = std::max(whole.max, part.max);
    whole.sum += part.sum;
    whole.below_normal += part.below_normal;
    whole.filled += part.filled;
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
    float largest = *std::ranges::max_element(most);
    for (; i < count; ++i) largest = std::max(largest, values[i]);
    return largest;
}

// Adds the first of the largest voxels of each eighth of a box, in one channel. An eighth in which
// no value is above 0 adds nothing.
void add_box_peaks(const float* values, const VoxelBox& box, int channel,
                   std::vector<VoxelPeak>& peaks) {
    constexpr std::size_t kParts = 8;
    const auto count = static_cast<std::size_t>(box.count());
    for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t first = part * count / kParts;
        const std::size_t last = (part + 1) * count / kParts;
        const float largest = largest_of(values + first, last - first);
        if (largest <= 0) continue;
        const auto at = std::find(values + first, values + last, largest) - values;
        peaks.push_back({voxel_at(box, at), channel, largest});
    }
}

// Marks the columns of a box that have a value above `above`.
void mark_columns(const float* values, const VoxelBox& box, float above,
                  std::vector<char>& columns) {
    columns.assign(static_cast<std::size_t>(box.size[0]) * static_cast<std::size_t>(box.size[1]),
                   0);
    for (int z = 0; z < box.size[2]; ++z) {
        for (char& column : columns) {
            column = static_cast<char>(column | static_cast<char>(*values++ > above));
        }
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
           const std::vector<std::array<double, 2>>& histogram_ranges, const BakeOptions& options,
           ColumnCount* count)
        : volume_(volume),
          level_(volume.levels[static_cast<std::size_t>(level)]),
          number_(level),
          ranges_(histogram_ranges),
          options_(options),
          count_(count),
          step_(level > 0 || options.certification == Certification::off
                    ? 0
                    : VoxelBox{{}, level_.size}.count() / kMostChosen + 1),
          boxes_(level_.size, static_cast<int>(volume.channel_names.size())),
          whole_(volume.channel_names.size()) {
        if (count_ != nullptr) covered_.resize(width() * static_cast<std::size_t>(level_.size[1]));
    }

    // Returns false after an interruption or a bad value.
    bool run() {
        bool finished = true;
        // Neighbouring slices take as long as each other: with one box less all threads are busy, too.
        take_boxes<Slot>(
            boxes_.count(), options_.threads, box_slots(options_.threads) - 1,
            [&](int i, Slot& slot) { look_at(i, slot); },
            [&](int i, const Slot& slot) { return finished = take(i, slot); });
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
        if (step_ > 0) level.filled = {filled_, static_cast<double>(whole_[0].filled) / count};
        if (count_ == nullptr) return;
        const auto covered = std::ranges::count(covered_, 1);
        count_->share = static_cast<double>(covered) / static_cast<double>(covered_.size());
    }

  private:
    static constexpr std::int64_t kMostChosen = 1 << 16;

    std::size_t width() const { return static_cast<std::size_t>(level_.size[0]); }

    void look_at(int index, Slot& slot) const {
        if (options_.cancelled()) return;
        const VoxelBox box = boxes_[index];
        const auto count = static_cast<std::size_t>(box.count());
        const std::size_t channels = whole_.size();
        slot.values.resize(count * channels);
        std::vector<float*> planes;
        for (std::size_t c = 0; c < channels; ++c) planes.push_back(&slot.values[c * count]);
        level_.voxels->fill(box, planes);
        slot.bad.reset();
        slot.channels.clear();
        const auto width = bytes_per_value(volume_.pixel_type);
        slot.bytes.resize(count * channels * width);
        for (std::size_t c = 0; c < channels; ++c) {
            const auto summary =
                summarize(planes[c], count, ranges_[c], volume_.pixel_type, c == 0 ? step_ : 0,
                          slot.bytes.data() + c * count * width);
            if (!summary) {
                slot.bad = first_bad(planes, volume_.pixel_type);
                return;
            }
            slot.channels.push_back(*summary);
        }
        slot.peaks.clear();
        for (std::size_t c = 0; c < channels; ++c) {
            add_box_peaks(planes[c], box, static_cast<int>(c), slot.peaks);
        }
        if (count_ != nullptr) mark_columns(planes[0], box, count_->above, slot.covered);
        // Several channels are stored interleaved.
        if (channels > 1) {
            store_voxels({planes.begin(), planes.end()}, count, volume_.pixel_type,
                         slot.bytes.data());
        }
    }

    bool take(int index, const Slot& slot) {
        if (options_.cancelled()) return false;
        if (slot.bad) {
            problem_ = diagnostic(boxes_[index], *slot.bad);
            return false;
        }
        for (std::size_t c = 0; c < whole_.size(); ++c) add(slot.channels[c], whole_[c]);
        peaks_.insert(peaks_.end(), slot.peaks.begin(), slot.peaks.end());
        for (const std::size_t chosen : slot.channels[0].chosen) {
            filled_.push_back(voxel_at(boxes_[index], static_cast<std::int64_t>(chosen)));
        }
        hasher_.update(slot.bytes);
        if (count_ != nullptr) {
            const std::size_t first = static_cast<std::size_t>(boxes_[index].origin[1]) * width();
            for (std::size_t i = 0; i < slot.covered.size(); ++i) {
                covered_[first + i] = std::max(covered_[first + i], slot.covered[i]);
            }
        }
        if (options_.progress != nullptr) {
            options_.progress->advance("voxels", (index + 1.0) / boxes_.count());
        }
        return true;
    }

    Diagnostic diagnostic(const VoxelBox& box, const BadValue& bad) const {
        const auto [x, y, z] = voxel_at(box, static_cast<std::int64_t>(bad.index));
        const std::string level = number_ == 0 ? "" : fmt::format(" of level {}", number_);
        const std::string place =
            fmt::format("`{}`: the value at voxel ({}, {}, {}){}, channel {},", volume_.name, x, y,
                        z, level, volume_.channel_names[bad.channel]);
        if (!std::isfinite(bad.value)) return diagnosis("E0401", place + " is not finite");
        const std::string range = range_text(volume_.pixel_type);
        const bool is_noise = volume_.kind == "noise_volume";
        const bool is_half = volume_.pixel_type == PixelType::half;
        return diagnosis(
            "E0402", fmt::format("{} is {}, outside {}", place, bad.value, range),
            fmt::format(
                "{}bake it as {}",
                is_noise
                    ? fmt::format(
                          "bring it into {} with the channel's remap, smoothstep or clamp, or ",
                          range)
                    : "",
                is_half ? "float" : "half or float"),
            "pixel_type");
    }

    const Baked& volume_;
    const Level& level_;
    const int number_;
    const std::vector<std::array<double, 2>>& ranges_;
    const BakeOptions& options_;
    ColumnCount* const count_;
    const std::int64_t step_;  // from one chosen voxel to the next; 0 where no certificate looks
    const BoxSequence boxes_;
    std::vector<Summary> whole_;
    std::vector<VoxelPeak> peaks_;
    std::vector<std::array<int, 3>> filled_;
    std::vector<char> covered_;
    Hasher hasher_;
    std::optional<Diagnostic> problem_;
};

}  // namespace

std::vector<Diagnostic> survey_level(Baked& volume, int level,
                                     const std::vector<std::array<double, 2>>& histogram_ranges,
                                     const BakeOptions& options, ColumnCount* count) {
    Survey survey(volume, level, histogram_ranges, options, count);
    if (!survey.run()) {
        if (survey.problem()) return {*survey.problem()};
        return {};
    }
    survey.fill(volume.levels[static_cast<std::size_t>(level)], volume.range);
    return {};
}

}  // namespace skybake
