#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/convection/transport.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/convection/kernel_rows.h"
#include "bakers/convection/transport.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::convection::HWY_NAMESPACE {
namespace {

HWY_INLINE float upwind_flux(float wind, float a, float b, float c, float d, float e, float f) {
    constexpr float k60th = 1.0F / 60.0F;
    const float mean = (37.0F * (c + d) - 8.0F * (b + e)) + (a + f);
    const float difference = (10.0F * (d - c) - 5.0F * (e - b)) + (f - a);
    return (wind * mean - std::fabs(wind) * difference) * k60th;
}

// The value at the upper face of c, from a to e along the wind.
HWY_INLINE float weighted_value(float a, float b, float c, float d, float e) {
    constexpr float kFloor = 1e-6F;  // K2 or g2/kg2: below it differences are noise
    const float first = (2.0F * a - 7.0F * b) + 11.0F * c;
    const float second = (5.0F * c - b) + 2.0F * d;
    const float third = (2.0F * c + 5.0F * d) - e;
    const float bend_1 = (a - 2.0F * b) + c, slope_1 = (a - 4.0F * b) + 3.0F * c;
    const float bend_2 = (b - 2.0F * c) + d, slope_2 = b - d;
    const float bend_3 = (c - 2.0F * d) + e, slope_3 = (3.0F * c - 4.0F * d) + e;
    constexpr float kBend = 13.0F / 3.0F;
    const float rough_1 = kBend * bend_1 * bend_1 + slope_1 * slope_1;
    const float rough_2 = kBend * bend_2 * bend_2 + slope_2 * slope_2;
    const float rough_3 = kBend * bend_3 * bend_3 + slope_3 * slope_3;
    const float spread = std::fabs(rough_1 - rough_3);
    const float r1 = 1.0F + spread / (rough_1 + kFloor);
    const float r2 = 1.0F + spread / (rough_2 + kFloor);
    const float r3 = 1.0F + spread / (rough_3 + kFloor);
    const float w1 = r1, w2 = 6.0F * r2, w3 = 3.0F * r3;
    return ((w1 * first + w2 * second) + w3 * third) / (6.0F * ((w1 + w2) + w3));
}

HWY_INLINE float weighted_flux(float wind, float a, float b, float c, float d, float e, float f) {
    const bool forward = wind >= 0.0F;
    return wind * weighted_value(forward ? a : f, forward ? b : e, forward ? c : d, forward ? d : c,
                                 forward ? e : b);
}

template <bool kWeighted>
void fluxes(const FaceRow& face, int count, float* __restrict out) {
    const float* __restrict a = face.cells[0];
    const float* __restrict b = face.cells[1];
    const float* __restrict c = face.cells[2];
    const float* __restrict d = face.cells[3];
    const float* __restrict e = face.cells[4];
    const float* __restrict f = face.cells[5];
    const float* __restrict here = face.wind;
    const float* __restrict before = face.wind_before;
    for (int i = 0; i < count; ++i) {
        const float wind = 0.5F * (here[i] + before[i]);
        out[i] = kWeighted ? weighted_flux(wind, a[i], b[i], c[i], d[i], e[i], f[i])
                           : upwind_flux(wind, a[i], b[i], c[i], d[i], e[i], f[i]);
    }
}

}  // namespace

void Fluxes(bool weighted, const FaceRow& face, int count, float* out) {
    if (weighted) {
        fluxes<true>(face, count, out);
    } else {
        fluxes<false>(face, count, out);
    }
}

void Sum(const FluxRow& row, int count, float* __restrict to) {
    const float* __restrict x = row.x;
    const float* __restrict south = row.south;
    const float* __restrict north = row.north;
    const float* __restrict below = row.below;
    const float* __restrict above = row.above;
    const float* __restrict base = row.base;
    for (int i = 0; i < count; ++i) {
        const float tendency =
            ((x[i] - x[i + 1]) * row.scale[0] + (south[i] - north[i]) * row.scale[1]) +
            (below[i] - above[i]) * row.scale[2];
        to[i] = base[i] + tendency;
    }
}

}  // namespace skybake::convection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::convection {

HWY_EXPORT(Fluxes);
HWY_EXPORT(Sum);

namespace {

class LevelTransport {
  public:
    LevelTransport(const Grid& grid, const Transport& what, Field& to)
        : grid_(grid),
          what_(what),
          to_(to),
          count_(grid.cells[0]),
          still_(static_cast<std::size_t>(grid.stride()), 0.0F),
          x_(still_.size()),
          south_(still_.size()),
          north_(still_.size()),
          below_(grid.plane()),
          above_(grid.plane()) {}

    void make_lower_faces(int z) {
        for (int y = 0; y < grid_.cells[1]; ++y) flux(2, y, z, level_row(below_, y));
    }

    // The faces below must have been made.
    void make_level(int z) {
        flux(1, 0, z, south_.data());
        for (int y = 0; y < grid_.cells[1]; ++y) {
            flux(0, y, z, x_.data());
            flux(1, y + 1, z, north_.data());
            flux(2, y, z + 1, level_row(above_, y));
            const float step = what_.step_s;
            HWY_DYNAMIC_DISPATCH(Sum)
            ({x_.data(),
              south_.data(),
              north_.data(),
              level_row(below_, y),
              level_row(above_, y),
              what_.base.row(y, z),
              {step / grid_.edge_m[0], step / grid_.edge_m[1], step / grid_.edge_m[2]}},
             count_, to_.row(y, z));
            south_.swap(north_);
            to_.wrap(y, z);
        }
        below_.swap(above_);
    }

  private:
    float* level_row(std::vector<float>& level, int y) {
        return level.data() + static_cast<std::size_t>(y) * still_.size();
    }

    const float* still() const { return still_.data() + kMargin; }

    // The wind at row y of level z, which is 0 outside of floor and lid along z.
    const float* wind(int axis, int y, int z) const {
        const bool is_wall = axis == 2 && (z <= 0 || z >= grid_.cells[2]);
        return is_wall ? still() : what_.velocity[static_cast<std::size_t>(axis)].row(y, z);
    }

    // Cells of level z; a vertical wind's beyond the lid are 0.
    const float* cells(int y, int z) const {
        const bool is_lid = what_.shifted_axis == 2 && z >= grid_.cells[2];
        return is_lid ? still() : what_.from.row(y, z);
    }

    // The fluxes through the lower faces of row y of level z along an axis.
    void flux(int axis, int y, int z, float* out) {
        FaceRow face;
        for (int i = 0; i < 6; ++i) {
            const int away = i - 3;
            face.cells[static_cast<std::size_t>(i)] = axis == 0   ? cells(y, z) + away
                                                      : axis == 1 ? cells(y + away, z)
                                                                  : cells(y, z + away);
        }
        face.wind = wind(axis, y, z);
        const int shifted = what_.shifted_axis;
        face.wind_before = shifted == 0   ? face.wind - 1
                           : shifted == 1 ? wind(axis, y - 1, z)
                           : shifted == 2 ? wind(axis, y, z - 1)
                                          : face.wind;
        HWY_DYNAMIC_DISPATCH(Fluxes)
        (what_.flux == Flux::weighted, face, axis == 0 ? count_ + 1 : count_, out);
    }

    const Grid& grid_;
    const Transport& what_;
    Field& to_;
    int count_;
    std::vector<float> still_, x_, south_, north_, below_, above_;
};

}  // namespace

void transport(const Grid& grid, const Transport& what, int first, int last, Field& to) {
    LevelTransport level(grid, what, to);
    level.make_lower_faces(first);
    for (int z = first; z < last; ++z) level.make_level(z);
}

}  // namespace skybake::convection
#endif  // HWY_ONCE
