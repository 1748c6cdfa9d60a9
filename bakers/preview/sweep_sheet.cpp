#include "bakers/preview/sweep_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "bakers/plot/chart.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// A page shows so many pictures side by side that each is still worth looking at.
constexpr std::size_t most_columns = 6;

// The two axes of a sheet. Those before them name its blocks.
struct SheetAxes {
    std::size_t down;
    std::size_t across;
};

// Returns the last two axes. The longer one runs across if it has room there, since screens are wide.
SheetAxes sheet_axes(const PreviewSweep& sweep) {
    SheetAxes axes = {sweep.axes.size() - 2, sweep.axes.size() - 1};
    const std::size_t down = sweep.axes[axes.down].size(), across = sweep.axes[axes.across].size();
    const bool longer_fits = std::max(down, across) <= most_columns;
    if (longer_fits ? down > across : down < across) std::swap(axes.down, axes.across);
    return axes;
}

// Returns the variant's place along the axes that name blocks, as one number.
std::size_t block_of(const PreviewSweep& sweep, const SweepVariant& variant) {
    std::size_t block = 0;
    for (std::size_t axis = 0; axis + 2 < sweep.axes.size(); ++axis) {
        block = block * sweep.axes[axis].size() + sweep.place(variant, axis);
    }
    return block;
}

Picture sheet_by_axes(const PreviewSweep& sweep, const std::vector<Picture>& pictures) {
    const SheetAxes axes = sheet_axes(sweep);
    const std::vector<std::string>& rows = sweep.axes[axes.down];
    const std::vector<std::string>& columns = sweep.axes[axes.across];
    std::vector<SheetBlock> blocks;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const SweepVariant& variant = sweep.variants[i];
        const std::size_t at = block_of(sweep, variant);
        while (blocks.size() <= at) {
            blocks.push_back(
                {"", columns, rows, std::vector<Picture>(rows.size() * columns.size())});
        }
        std::string title;
        for (std::size_t axis = 0; axis + 2 < sweep.axes.size(); ++axis) {
            title += (axis == 0 ? "" : ", ") + sweep.axes[axis][sweep.place(variant, axis)];
        }
        blocks[at].title = std::move(title);
        const std::size_t row = sweep.place(variant, axes.down);
        blocks[at].pictures[row * columns.size() + sweep.place(variant, axes.across)] = pictures[i];
    }
    return contact_sheet(blocks);
}

// Chooses the number of columns so that the sheet is about twice as wide as it is high.
Picture sheet_by_captions(const PreviewSweep& sweep, const std::vector<Picture>& pictures) {
    std::vector<Picture> shown;
    std::vector<std::string> captions;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (pictures[i].rgb.empty()) continue;
        shown.push_back(pictures[i]);
        captions.push_back(sweep.label(sweep.variants[i]));
    }
    const double shape = 1.0 * shown.front().width / shown.front().height;
    const auto count = static_cast<double>(shown.size());
    const auto columns = std::lround(std::sqrt(2 * count / shape));
    return contact_sheet(shown, captions, std::max(1, static_cast<int>(columns)));
}

Picture sheet_of(const PreviewSweep& sweep, const std::vector<Picture>& pictures) {
    return sweep.axes.size() > 1 && sweep.variants.size() <= most_pictured_variants
               ? sheet_by_axes(sweep, pictures)
               : sheet_by_captions(sweep, pictures);
}

bool same_size(const Picture& picture, const Picture& other) {
    return !picture.rgb.empty() && picture.width == other.width && picture.height == other.height;
}

// Returns the largest difference of a channel of any picture from the first.
int largest_difference(const std::vector<Picture>& pictures, const Picture& first) {
    int largest = 0;
    for (const Picture& picture : pictures) {
        if (!same_size(picture, first)) continue;
        for (std::size_t i = 0; i < first.rgb.size(); ++i) {
            largest = std::max(largest, std::abs(picture.rgb[i] - first.rgb[i]));
        }
    }
    return largest;
}

// Returns grey where the pictures are equal, and elsewhere grey plus `gain` times their difference.
Picture difference_picture(const Picture& picture, const Picture& first, int gain) {
    constexpr int grey = 128;
    if (!same_size(picture, first)) return {};
    Picture difference(first.width, first.height);
    for (std::size_t i = 0; i < first.rgb.size(); ++i) {
        const int value = grey + gain * (picture.rgb[i] - first.rgb[i]);
        difference.rgb[i] = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
    }
    return difference;
}

// Returns the sheet of differences, or nothing if there are none.
std::optional<PreviewPicture> difference_sheet(const PreviewSweep& sweep,
                                               const std::vector<Picture>& pictures,
                                               const Picture& first) {
    const int largest = largest_difference(pictures, first);
    if (largest == 0) return std::nullopt;
    const int gain = std::max(1, 127 / largest);
    const auto differences = mapped<Picture>(
        pictures, [&](const Picture& picture) { return difference_picture(picture, first, gain); });
    PreviewPicture sheet;
    sheet.name = "contact_sheet_difference";
    sheet.title = "Difference from the first variant";
    sheet.caption = fmt::format(
        "Each picture minus the first, {} times enlarged, on grey. The largest difference is {} of "
        "255.",
        gain, largest);
    sheet.picture = sheet_of(sweep, differences);
    return sheet;
}

}  // namespace

std::optional<double> rms_difference(const Picture& picture, const Picture& other) {
    if (!same_size(picture, other)) return std::nullopt;
    double sum = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double difference = picture.rgb[i] - other.rgb[i];
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(picture.rgb.size()));
}

std::vector<PreviewPicture> sweep_sheets(const PreviewSweep& sweep,
                                         const std::vector<Picture>& pictures,
                                         const std::string& light) {
    const auto first =
        std::ranges::find_if(pictures, [](const Picture& picture) { return !picture.rgb.empty(); });
    if (first == pictures.end()) return {};
    const auto count = std::ranges::count_if(
        pictures, [](const Picture& picture) { return !picture.rgb.empty(); });
    PreviewPicture sheet;
    sheet.name = "contact_sheet";
    sheet.title = "All variants";
    if (static_cast<std::size_t>(count) < sweep.variants.size()) {
        sheet.title = fmt::format("{} of {} variants", count, sweep.variants.size());
    }
    sheet.caption = "Each picture is shown with the values that vary.";
    if (!light.empty()) sheet.caption += fmt::format(" They all have {}.", light);
    sheet.picture = sheet_of(sweep, pictures);
    std::vector<PreviewPicture> sheets = {std::move(sheet)};
    if (auto difference = difference_sheet(sweep, pictures, *first)) {
        sheets.push_back(std::move(*difference));
    }
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        sheets[i].kind = PictureKind::scene;
        sheets[i].group = "sheets";
        sheets[i].tab = i == 0 ? "Pictures" : "Difference from the first";
    }
    return sheets;
}

}  // namespace skybake
