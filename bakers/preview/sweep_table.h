// The table of a sweep: a row for each variant with its values, errors, bytes and times.
//
// Plots of a sweep: what each asset's error costs, over the user's own axes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/plot/drawing.h"
#include "bakers/preview/load_sweep.h"
#include "bakers/preview/page.h"

namespace skybake {

class SweepTable {
  public:
    // The sweep must outlive the table.
    explicit SweepTable(const PreviewSweep& sweep);

    // Returns what varies, then for each asset the figures that any variant has, then the difference
    // of the picture from the first, then the status. Assets that are the same in all variants come
    // last.
    std::vector<PageTable::Column> columns() const;

    // Returns the row of a variant, without its picture. `difference` is that of its picture from
    // the first; `folder` is that of the sweep, as seen from the page.
    PageVariant row(const SweepVariant& variant, std::optional<double> difference,
                    const std::filesystem::path& folder) const;

  private:
    struct Figure {
        std::string asset;
        std::string name;  // as in PreviewSweep
        PageTable::Column column;
    };

    const PreviewSweep& sweep_;
    std::vector<Figure> figures_;
};

// Returns a plot of each asset whose error or cost varies: its error against the bytes of its files,
// and against the time of its bake if that is known. The error is the median of the sky's if that was
// measured, else the RMS of lookups.
std::vector<PreviewPicture> sweep_plots(const PreviewSweep& sweep);

}  // namespace skybake
