#include "bakers/march/sun_leaps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bakers/math/parallel.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake {
namespace {

using Cell = std::array<int, 3>;

// A piece of the beam, which is the moving box of sun_leaps.h. Up to the time `end`, in steps, the
// beam lies in the cells from `first` to `first` + `more`, relative to its first cell.
struct BeamPiece {
    double end = 0;
    Cell first{};
    Cell more{};  // 0, 1 or 2
};

// A corner of the beam along one axis, in cells from the lower corner of the cell that it starts
// in. Its place is at + t * speed, but never behind `start`.
struct Corner {
    double at = 0;
    double start = 0;
    double speed = 0;  // per step

    double place(double t) const {
        const double moved = at + t * speed;
        return speed > 0 ? std::max(moved, start) : std::min(moved, start);
    }
};

struct BeamAxis {
    Corner low;
    Corner high;
};

BeamAxis beam_axis(double speed, double margin) {
    // Places range from the lower face of the cell to just below its upper face.
    constexpr double kBelowOne = 1 - 0x1p-40;
    if (speed > 0) return {{-margin, 0, speed}, {1 + margin, 1 + margin, speed}};
    if (speed < 0) return {{-margin, -margin, speed}, {1 + margin, kBelowOne, speed}};
    return {{0, 0, 0}, {0, kBelowOne, 0}};
}

// Adds the times at which a corner enters another cell.
void add_crossings(const Corner& corner, double last, std::vector<double>& times) {
    if (corner.speed == 0) return;
    const auto begin = static_cast<int>(std::floor(std::min(corner.place(0), corner.place(last))));
    const auto end = static_cast<int>(std::ceil(std::max(corner.place(0), corner.place(last))));
    for (int face = begin; face <= end; ++face) {
        const double t = (face - corner.at) / corner.speed;
        if (t > 0 && t < last) times.push_back(t);
    }
}

std::vector<BeamPiece> beam_pieces(const std::array<BeamAxis, 3>& axes, double last) {
    std::vector<double> times;
    for (const BeamAxis& axis : axes) {
        add_crossings(axis.low, last, times);
        add_crossings(axis.high, last, times);
    }
    times.push_back(last);
    std::ranges::sort(times);
    std::vector<BeamPiece> pieces;
    double begin = 0;
    for (const double end : times) {
        BeamPiece piece;
        piece.end = end;
        const double middle = 0.5 * (begin + end);
        for (std::size_t a = 0; a < 3; ++a) {
            piece.first[a] = static_cast<int>(std::floor(axes[a].low.place(middle)));
            piece.more[a] =
                static_cast<int>(std::floor(axes[a].high.place(middle))) - piece.first[a];
        }
        if (end > begin) pieces.push_back(piece);
        begin = end;
    }
    return pieces;
}

// Tells whether any cell of a box is occupied. The box extends from one cell over `more` further
// cells along each axis.
class OccupiedBoxes {
  public:
    explicit OccupiedBoxes(const LeapGrid& grid) : cells_(grid.cells) {
        const std::size_t count = grid.reach.size();
        boxes_[0].resize(count);
        for (std::size_t i = 0; i < count; ++i) boxes_[0][i] = grid.reach[i] < 0 ? 1 : 0;
        for (int code = 1; code < 27; ++code) {
            const Cell more = {code % 3, code / 3 % 3, code / 9};
            const std::size_t axis = more[0] > 0 ? 0 : more[1] > 0 ? 1 : 2;
            Cell less = more;
            --less[axis];
            boxes_[static_cast<std::size_t>(code)] = widened(at(less), axis);
        }
    }

    bool occupied(const Cell& cell, const Cell& more) const {
        // A box outside of the layer along z meets nothing; one that begins below it is cut to the
        // layer.
        if (cell[2] >= cells_[2] || cell[2] + more[2] < 0) return false;
        const int below = std::max(-cell[2], 0);
        Cell rest = more;
        rest[2] -= below;
        return at(rest)[occupancy::index_of(cells_, occupancy::wrapped(cell[0], cells_[0]),
                                            occupancy::wrapped(cell[1], cells_[1]),
                                            cell[2] + below)] != 0;
    }

  private:
    using Bits = std::vector<std::uint8_t>;

    const Bits& at(const Cell& more) const {
        return boxes_[static_cast<std::size_t>(more[0] + 3 * more[1] + 9 * more[2])];
    }

    // Combines each cell with the next one along an axis; the highest cell has none above it.
    Bits widened(const Bits& bits, std::size_t axis) const {
        Bits result(bits.size());
        for (int z = 0; z < cells_[2]; ++z) {
            for (int y = 0; y < cells_[1]; ++y) {
                for (int x = 0; x < cells_[0]; ++x) {
                    Cell other = {x, y, z};
                    other[axis] += 1;
                    const std::size_t here = occupancy::index_of(cells_, x, y, z);
                    const bool beyond = other[2] >= cells_[2];
                    const std::size_t there =
                        occupancy::index_of(cells_, other[0] % cells_[0], other[1] % cells_[1],
                                            std::min(other[2], cells_[2] - 1));
                    result[here] =
                        static_cast<std::uint8_t>(bits[here] | (beyond ? 0 : bits[there]));
                }
            }
        }
        return result;
    }

    Cell cells_;
    std::array<Bits, 27> boxes_;
};

// Returns the number of samples within the reach that is empty in every direction, minus one voxel
// for rounding.
float samples_in_reach(float reach, double fastest) {
    if (fastest == 0) return 0;
    return static_cast<float>(
        std::min(std::floor(std::max(double{reach} - 1, 0.0) / fastest), 0x1p20));
}

}  // namespace

std::vector<float> sun_leaps(const LeapGrid& grid, const std::array<int, 3>& voxels,
                             const glm::dvec3& direction, int samples, int threads) {
    double fastest = 0;
    for (std::size_t a = 0; a < 3; ++a) fastest = std::max(fastest, std::fabs(direction[a]));
    const bool regular = voxels[0] % grid.cell == 0 && voxels[1] % grid.cell == 0 &&
                         samples * fastest <= kLongestBeam &&
                         *std::ranges::max_element(voxels) <= kLongestBeam;
    std::array<BeamAxis, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        axes[a] = beam_axis(direction[a] / grid.cell, kBeamMargin / grid.cell);
    }
    const std::vector<BeamPiece> pieces =
        regular ? beam_pieces(axes, samples) : std::vector<BeamPiece>();
    const OccupiedBoxes boxes(grid);
    std::vector<float> leaps(grid.reach.size());
    parallel_for(grid.cells[2], threads, [&](int z) {
        for (int y = 0; y < grid.cells[1]; ++y) {
            for (int x = 0; x < grid.cells[0]; ++x) {
                const std::size_t index = occupancy::index_of(grid.cells, x, y, z);
                if (grid.reach[index] < 0) {
                    leaps[index] = -1;
                    continue;
                }
                double free = 0;
                for (const BeamPiece& piece : pieces) {
                    const Cell cell = {x + piece.first[0], y + piece.first[1], z + piece.first[2]};
                    if (boxes.occupied(cell, piece.more)) break;
                    free = piece.end;
                }
                leaps[index] = std::max(static_cast<float>(std::floor(free)),
                                        samples_in_reach(grid.reach[index], fastest));
            }
        }
    });
    return leaps;
}

}  // namespace skybake
