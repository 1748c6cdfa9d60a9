// The state of a batch of paths: columns of numbers, which are loaded for a vector of paths at a time, and
// packets of wavelengths, one for each path. Paths that have ended are removed.
#if defined(SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STATE_INL_H_
#undef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STATE_INL_H_
#else
#define SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STATE_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bakers/light/path_tracer/path_batch.h"
#include "bakers/light/path_tracer/path_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

constexpr std::size_t kLanes = Lanes::kCount;
// Whole vectors of the paths of a batch.
constexpr std::size_t kRoom = (PathBatch::kPaths + kLanes - 1) / kLanes * kLanes;

struct Column {
    double values[kRoom];
    double& operator[](std::size_t path) { return values[path]; }
    HWY_INLINE Lanes load(std::size_t path) const { return Lanes::load(values + path); }
    HWY_INLINE LaneMask flags(std::size_t path) const { return load(path) > Lanes(0.0); }
    HWY_INLINE void store(std::size_t path, Lanes x) { x.store(values + path); }
    HWY_INLINE void store(std::size_t path, LaneMask flags) {
        store(path, zero_unless(flags, Lanes(1.0)));
    }
};

struct Packets {
    double values[PathBatch::kPaths][kChannelSlots];
    HWY_INLINE Channels load(std::size_t path) const { return Channels::load(values[path]); }
    HWY_INLINE void store(std::size_t path, Channels x) { x.store(values[path]); }
    double at(std::size_t path, std::size_t channel) const { return values[path][channel]; }
};

struct DirectionColumns {
    Column x, y, z;
    HWY_INLINE Direction<Lanes> load(std::size_t path) const {
        return {x.load(path), y.load(path), z.load(path)};
    }
    HWY_INLINE void store(std::size_t path, const Direction<Lanes>& vector) {
        x.store(path, vector.x);
        y.store(path, vector.y);
        z.store(path, vector.z);
    }
    void set(std::size_t path, const glm::dvec3& vector) {
        x[path] = vector.x;
        y[path] = vector.y;
        z[path] = vector.z;
    }
};

// The state of a path that is kept from one flight to the next. Flags are 0 or 1.
struct PathColumns {
    DirectionColumns up, direction;
    Column altitude_km, shell;
    Column path;  // its number in the batch
    Column hero;
    Column s_km, falls, hits_ground, lowest_shell;  // of its flight
};
struct PathPackets {
    Packets weight, ratio;
    Packets from, lowest, scattered, returned;  // of its flight
};

// The paths of a batch that go on, and what is common to the stages that they take.
class PathState {
  public:
    PathState(const PathMedium& medium, const PathSource& source, const PathRules& rules,
              PathBatch& batch)
        : medium_(medium),
          air_(medium.air().tables()),
          source_(source),
          rules_(rules),
          batch_(batch),
          numbers_(batch.numbers),
          channels_(static_cast<double>(medium.sky().air.channels)),
          density_(medium.scatterers().size()),
          phase_(medium.scatterers().size() * kChannelSlots) {}

  protected:
    std::size_t number_of(std::size_t i) const {
        return static_cast<std::size_t>(columns_.path.values[i]);
    }
    std::size_t hero_of(std::size_t i) const {
        return static_cast<std::size_t>(columns_.hero.values[i]);
    }
    std::size_t shell_of(std::size_t i) const {
        return static_cast<std::size_t>(columns_.shell.values[i]);
    }
    bool is_on_ground(std::size_t i) const { return on_ground_.values[i] > 0; }
    Channels worth(std::size_t i) const {
        const double* ratio = packets_.ratio.values[i];
        return (channels_ / (ratio[0] + ratio[1] + ratio[2] + ratio[3])) * packets_.weight.load(i);
    }

    void copy(std::size_t from, std::size_t to) {
        constexpr std::size_t kColumns = sizeof(PathColumns) / sizeof(Column);
        auto* column = reinterpret_cast<Column*>(&columns_);
        for (std::size_t k = 0; k < kColumns; ++k) column[k][to] = column[k][from];
    }

    // Removes the paths that have ended.
    void remove_ended() {
        constexpr std::size_t kPackets = sizeof(PathPackets) / sizeof(Packets);
        auto* packets = reinterpret_cast<Packets*>(&packets_);
        std::size_t left = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i]) continue;
            if (left < i) {
                copy(i, left);
                for (std::size_t k = 0; k < kPackets; ++k) {
                    packets[k].store(left, packets[k].load(i));
                }
            }
            ++left;
        }
        count_ = left;
        std::fill_n(ended_, PathBatch::kPaths, false);
    }

    void gather(std::size_t i, Channels light) {
        PathLight& sum = batch_.light[number_of(i)];
        Spectrum& gathered = order_of_event_ == 0
                                 ? sum.direct
                                 : sum.orders[std::min(order_of_event_, kPathOrders) - 1];
        (Channels(gathered) + light).store(data(gathered));
    }

    const PathMedium& medium_;
    const AirTables& air_;
    const PathSource& source_;
    const PathRules& rules_;
    PathBatch& batch_;
    BatchNumbers& numbers_;
    const double channels_;

    std::size_t count_ = 0;
    std::size_t order_ = 0;           // events before this flight
    std::size_t order_of_event_ = 0;  // events before the light that is gathered
    bool ended_[PathBatch::kPaths] = {};
    PathColumns columns_{};
    PathPackets packets_{};

    // Results that stages hand to the next ones.
    Packets through_{};
    Column lowest_altitude_km_{}, lowest_s_km_{};
    Column scattered_share_{}, from_of_hero_{}, lowest_of_hero_{};
    Column on_ground_{};  // flags
    Column end_s_km_{}, still_falls_{};
    DirectionColumns sun_{};
    Column sun_cosine_{}, sun_s_km_{};
    std::size_t chosen_[PathBatch::kPaths] = {};  // scatterers
    Column share_{};                              // of the light that they scatter
    Column one_minus_{}, one_plus_{}, turns_{};
    Packets scattering_{};
    std::vector<Column> density_, phase_;  // of scatterers, and of their channels
    double one_packet_[kChannelSlots] = {};
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_STATE_INL_H_
