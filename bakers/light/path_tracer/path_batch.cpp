#include "bakers/light/path_tracer/path_batch.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/path_tracer/path_batch.cpp"
#include <hwy/foreach_target.h>

#include "bakers/air/particles/phase_function-inl.h"
#include "bakers/light/path_tracer/path_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

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

// What must be kept of a path from one flight to the next. Flags are 0 or 1.
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

// The paths of one batch and the stages that they take. Names are those of path_walk.cpp.
class Walk {
  public:
    Walk(const PathWalker& walker, const PathSource& source, const PathRules& rules,
         PathBatch& batch)
        : walker_(walker),
          air_(walker.air().tables()),
          source_(source),
          rules_(rules),
          batch_(batch),
          numbers_(batch.numbers),
          channels_(static_cast<double>(walker.medium().air.channels)),
          density_(walker.scatterers().size()),
          phase_(walker.scatterers().size() * kChannelSlots) {}

    void walk() {
        begin();
        for (order_ = 0; count_ > 0; ++order_) {
            if (order_ > 0) begin_flights();
            if (source_.ambient) see_source();
            if (order_ > 0) play_roulette();
            choose_ends();
            if (count_ == 0) return;
            arrive();
            look_around();
            if (!source_.ambient && (order_ > 0 || rules_.counts_first_order)) gather_sunlight();
            choose_angles();
            turn();
        }
    }

  private:
    // --- Paths ---

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

    // --- Flights ---

    void begin() {
        count_ = numbers_.count();
        assert(count_ <= PathBatch::kPaths);
        for (std::size_t i = 0; i < count_; ++i) {
            const PathStart& start = batch_.starts[i];
            columns_.up.set(i, start.up);
            columns_.direction.set(i, start.direction);
            columns_.altitude_km[i] = start.altitude_km;
            columns_.shell[i] = static_cast<double>(shell_at(air_, start.altitude_km));
            columns_.path[i] = static_cast<double>(i);
            columns_.hero[i] = static_cast<double>(batch_.heroes[i]);
            for (std::size_t c = 0; c < kChannelSlots; ++c) {
                const double one = static_cast<double>(c) < channels_ ? 1 : 0;
                packets_.weight.values[i][c] = one;
                packets_.ratio.values[i][c] = one;
            }
        }
        if (batch_.first == nullptr) begin_flights();
        for (std::size_t i = 0; i < count_; ++i) {
            if (batch_.first != nullptr) set_flight(i, *batch_.first);
            if (!rules_.sees_ground) packets_.returned.store(i, Channels(0.0));
        }
    }

    void set_flight(std::size_t i, const PathWalker::Flight& flight) {
        columns_.s_km[i] = flight.s_km;
        columns_.falls[i] = flight.falls ? 1 : 0;
        columns_.hits_ground[i] = flight.hits_ground ? 1 : 0;
        columns_.lowest_shell[i] = flight.lowest_shell;
        packets_.from.store(i, Channels(flight.from));
        packets_.lowest.store(i, Channels(flight.lowest));
        packets_.scattered.store(i, Channels(flight.scattered));
        packets_.returned.store(i, Channels(flight.returned));
        through_.store(i, Channels(flight.through));
    }

    void begin_flights() {
        for (std::size_t i = 0; i < count_; i += kLanes) {
            const FlightLine<Lanes> line =
                flight_line(air_.planet, columns_.altitude_km.load(i), columns_.up.load(i),
                            columns_.direction.load(i));
            columns_.s_km.store(i, line.s_km);
            columns_.falls.store(i, line.falls);
            columns_.hits_ground.store(i, line.hits_ground);
            lowest_altitude_km_.store(i, line.lowest_altitude_km);
            lowest_s_km_.store(i, line.lowest_s_km);
        }
        const Channels albedo(walker_.medium().air.ground_albedo);
        for (std::size_t i = 0; i < count_; ++i) {
            const Channels from = depth_to_top(air_, columns_.altitude_km[i],
                                               std::fabs(columns_.s_km[i]), shell_of(i));
            const bool hits_ground = columns_.hits_ground[i] > 0;
            Channels lowest = from;
            Channels depth = from;
            if (columns_.falls[i] > 0) {
                const std::size_t shell = shell_at(air_, lowest_altitude_km_[i]);
                columns_.lowest_shell[i] = static_cast<double>(shell);
                lowest = depth_to_top(air_, lowest_altitude_km_[i], lowest_s_km_[i], shell);
                depth = lowest - from;
                if (!hits_ground) depth = depth + lowest;
                depth = maximum(depth, Channels(0.0));  // rounding
            } else {
                columns_.lowest_shell[i] = columns_.shell[i];
            }
            const Channels through = exponential(-depth);
            packets_.from.store(i, from);
            packets_.lowest.store(i, lowest);
            packets_.scattered.store(i, scattered_share(depth, through));
            packets_.returned.store(i, hits_ground ? through * albedo : Channels(0.0));
            through_.store(i, through);
        }
    }

    void gather(std::size_t i, Channels light) {
        PathLight& sum = batch_.light[number_of(i)];
        Spectrum& gathered = order_of_event_ == 0
                                 ? sum.direct
                                 : sum.orders[std::min(order_of_event_, kPathOrders) - 1];
        (Channels(gathered) + light).store(data(gathered));
    }

    void see_source() {
        for (std::size_t i = 0; i < count_; ++i) {
            if (!(columns_.hits_ground[i] > 0)) gather(i, worth(i) * through_.load(i));
        }
    }

    void play_roulette() {
        numbers_.go_on();
        for (std::size_t i = 0; i < count_; ++i) {
            const Channels goes_on = packets_.scattered.load(i) + packets_.returned.load(i);
            const Channels worth_of_flight = worth(i) * goes_on;
            Spectrum& second_flight = batch_.second_flight[number_of(i)];
            if (order_ == 1) worth_of_flight.store(data(second_flight));
            const Channels known(rules_.usual_weight);
            const Channels usual = select(known > Channels(0.0), known, Channels(second_flight));
            zero_unless_positive(worth_of_flight, usual).store(one_packet_);
            const double survival =
                std::max({one_packet_[0], one_packet_[1], one_packet_[2], one_packet_[3]});
            if (survival >= 1) continue;
            ended_[i] = numbers_.of(number_of(i)) >= survival;
            packets_.weight.store(i, (1 / survival) * packets_.weight.load(i));
        }
    }

    // Chooses how far each path flies, and removes those that fly no more.
    void choose_ends() {
        for (std::size_t i = 0; i < count_; ++i) {
            const std::size_t hero = hero_of(i);
            const double goes_on = packets_.scattered.at(i, hero) + packets_.returned.at(i, hero);
            if (!(goes_on > 0)) ended_[i] = true;
        }
        remove_ended();
        numbers_.go_on();
        for (std::size_t i = 0; i < count_; ++i) {
            const std::size_t hero = hero_of(i);
            const double scattered = packets_.scattered.at(i, hero);
            const double returned = packets_.returned.at(i, hero);
            const std::size_t path = number_of(i);
            ++batch_.light[path].flights;
            // The ground lies behind all air.
            scattered_share_[i] = numbers_.of(path) * (scattered + returned);
            const bool on_ground = returned > 0 && scattered_share_[i] >= scattered;
            on_ground_[i] = on_ground ? 1 : 0;
            if (on_ground) scattered_share_[i] = 0;
            from_of_hero_[i] = packets_.from.at(i, hero);
            lowest_of_hero_[i] = packets_.lowest.at(i, hero);
        }
    }

    // --- Ends of flights ---

    void arrive() {
        // Lanes without a path repeat the last one.
        for (std::size_t i = count_; i % kLanes != 0; ++i) {
            copy(count_ - 1, i);
            for (Column* column :
                 {&scattered_share_, &from_of_hero_, &lowest_of_hero_, &on_ground_}) {
                (*column)[i] = (*column)[count_ - 1];
            }
        }
        for (std::size_t i = 0; i < count_; i += kLanes) move(i);
        for (std::size_t i = 0; i < count_; ++i) {
            if (is_on_ground(i)) {
                arrive_on_ground(i);
            } else {
                arrive_in_air(i);
            }
            ended_[i] = !(packets_.ratio.at(i, hero_of(i)) > 0);
        }
        order_of_event_ = order_ + 1;
    }

    // Goes to where the hero's depth from the start is that of the share, unless that is on the
    // ground.
    void move(std::size_t i) {
        const Lanes depth = depth_of_share(scattered_share_.load(i));
        const LaneMask falls = columns_.falls.flags(i);
        const Lanes from = from_of_hero_.load(i);
        const Lanes before_lowest = lowest_of_hero_.load(i) - from;
        const LaneMask still_falls =
            falls & (columns_.hits_ground.flags(i) | (depth < before_lowest));
        const Lanes upwards = select(falls, lowest_of_hero_.load(i) + before_lowest, from);
        const Lanes above = select(still_falls, from + depth, maximum(upwards - depth, Lanes(0.0)));
        const Lanes shell = columns_.shell.load(i);
        const Lanes highest =
            select(still_falls, shell, Lanes(static_cast<double>(air_.shells.size() - 1)));
        const Lanes altitude = columns_.altitude_km.load(i);
        const Lanes s = columns_.s_km.load(i);
        const PointInShell<Lanes> end =
            point_at_depth<Lanes>(air_, {altitude, absolute(s), shell}, from, columns_.hero.load(i),
                                  above, columns_.lowest_shell.load(i), highest);
        const Lanes radius = Lanes(air_.planet.ground_radius_km);
        const Lanes distance = select(still_falls, -end.s_km, end.s_km) - s;
        const Lanes r = radius + altitude;
        const Lanes scale = Lanes(1.0) / (radius + end.altitude_km);
        const Direction<Lanes> up = columns_.up.load(i);
        const Direction<Lanes> direction = columns_.direction.load(i);
        const LaneMask stays = on_ground_.flags(i);
        const auto place = [&](Lanes of_up, Lanes of_direction) {
            return select(stays, of_up, scale * (r * of_up + distance * of_direction));
        };
        columns_.up.store(
            i, {place(up.x, direction.x), place(up.y, direction.y), place(up.z, direction.z)});
        columns_.altitude_km.store(i, select(stays, altitude, end.altitude_km));
        columns_.shell.store(i, select(stays, shell, end.shell));
        end_s_km_.store(i, end.s_km);
        still_falls_.store(i, still_falls);
    }

    void arrive_in_air(std::size_t i) {
        const std::size_t shell = shell_of(i);
        const Channels from = packets_.from.load(i);
        const Channels above = depth_to_top(air_, columns_.altitude_km[i], end_s_km_[i], shell);
        const bool still_falls = still_falls_[i] > 0;
        Channels passed = still_falls ? above - from : from - above;
        if (columns_.falls[i] > 0 && !still_falls) {
            passed = passed + 2.0 * (packets_.lowest.load(i) - from);
        }
        passed = maximum(passed, Channels(0.0));  // rounding
        const Channels transmittance = exponential(-passed);
        const Channels extinction = extinction_at(air_, shell, columns_.altitude_km[i]);
        const Channels density = zero_unless_positive(
            extinction * transmittance, packets_.scattered.load(i) + packets_.returned.load(i));
        density.store(one_packet_);
        const double of_hero = one_packet_[hero_of(i)];
        const double inverse = of_hero > 0 ? 1 / of_hero : 0;
        packets_.weight.store(i, inverse * packets_.weight.load(i) * transmittance);
        packets_.ratio.store(i, inverse * packets_.ratio.load(i) * density);
    }

    void arrive_on_ground(std::size_t i) {
        const double radius = air_.planet.ground_radius_km;
        const double altitude = columns_.altitude_km[i];
        const double distance = distance_to_ground_km(air_.planet, altitude, columns_.s_km[i]);
        const auto place = [&](Column& up, Column& direction) {
            up[i] = (1 / radius) * ((radius + altitude) * up[i] + distance * direction[i]);
        };
        place(columns_.up.x, columns_.direction.x);
        place(columns_.up.y, columns_.direction.y);
        place(columns_.up.z, columns_.direction.z);
        columns_.altitude_km[i] = 0;
        columns_.shell[i] = 0;
        const Channels returned = packets_.returned.load(i);
        const Channels probability =
            zero_unless_positive(returned, packets_.scattered.load(i) + returned);
        probability.store(one_packet_);
        const double inverse = 1 / one_packet_[hero_of(i)];
        packets_.weight.store(i, inverse * packets_.weight.load(i) * returned);
        packets_.ratio.store(i, inverse * packets_.ratio.load(i) * probability);
    }

    // --- Events ---

    // What the layers scatter where the paths are.
    void look_around() {
        const auto& scatterers = walker_.scatterers();
        for (std::size_t i = 0; i < count_; ++i) {
            if (is_on_ground(i)) continue;
            Channels sum(0.0);
            for (std::size_t k = 0; k < scatterers.size(); ++k) {
                const double density =
                    density_at(air_, shell_of(i), static_cast<std::size_t>(scatterers[k].layer),
                               columns_.altitude_km[i]);
                density_[k][i] = std::max(density, 0.0);  // rounding
                sum = sum + density_[k][i] * Channels(scatterers[k].scattering_per_km);
            }
            scattering_.store(i, sum);
        }
    }

    // Computes the phase functions at one angle of each path.
    void look_at_angles() {
        const auto& scatterers = walker_.scatterers();
        for (std::size_t k = 0; k < scatterers.size(); ++k) {
            const auto& functions = scatterers[k].phase.functions;
            for (std::size_t c = 0; c < functions.size(); ++c) {
                look_at_angles(functions[c], phase_[k * kChannelSlots + c]);
            }
        }
    }

    void look_at_angles(const PhaseFunction& phase, Column& values) {
        if (phase.table) {
            for (std::size_t i = 0; i < count_; ++i) {
                if (is_on_ground(i)) continue;
                values[i] = phase_value(phase, one_minus_[i], one_plus_[i]);
            }
            return;
        }
        for (std::size_t i = 0; i < count_; i += kLanes) {
            values.store(i, closed_phase_value(phase.constant, phase.quadratic, phase.g,
                                               one_minus_.load(i), one_plus_.load(i)));
        }
    }

    // Sum of sigma_s p over layers.
    Channels towards(std::size_t i) const {
        const auto& scatterers = walker_.scatterers();
        Channels sum(0.0);
        for (std::size_t k = 0; k < scatterers.size(); ++k) {
            const Channels scattering(scatterers[k].scattering_per_km);
            const double density = density_[k].values[i];
            const Column* phase = phase_.data() + k * kChannelSlots;
            if (scatterers[k].phase.is_alike()) {
                sum = sum + density * phase[0].values[i] * scattering;
            } else {
                double values[kChannelSlots] = {};
                for (std::size_t c = 0; c < scatterers[k].phase.functions.size(); ++c) {
                    values[c] = phase[c].values[i];
                }
                sum = sum + density * Channels::load(values) * scattering;
            }
        }
        return sum;
    }

    void gather_sunlight() {
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i]) continue;
            sun_.set(i, sample_sun(source_, numbers_.random(number_of(i))));
        }
        for (std::size_t i = 0; i < count_; i += kLanes) {
            const Direction<Lanes> sun = sun_.load(i);
            const Lanes r = Lanes(air_.planet.ground_radius_km) + columns_.altitude_km.load(i);
            const Lanes cosine = dot(columns_.up.load(i), sun);
            sun_cosine_.store(i, cosine);
            sun_s_km_.store(i, r * cosine);
            const Angle<Lanes> angle = angle_between(sun, columns_.direction.load(i));
            one_minus_.store(i, angle.one_minus);
            one_plus_.store(i, angle.one_plus);
        }
        look_at_angles();
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i] || (is_on_ground(i) && !(sun_cosine_[i] > 0))) continue;
            const Channels light =
                sunlight(air_, columns_.altitude_km[i], sun_s_km_[i], shell_of(i));
            gather(i, is_on_ground(i) ? (sun_cosine_[i] / std::numbers::pi) * worth(i) * light
                                      : worth(i) * light * towards(i));
        }
    }

    void choose_angles() {
        numbers_.go_on();
        for (std::size_t i = 0; i < count_; ++i) {
            if (!is_on_ground(i) && !(scattering_.at(i, hero_of(i)) > 0)) ended_[i] = true;
            if (ended_[i]) continue;
            const double number = numbers_.of(number_of(i));
            if (is_on_ground(i)) {
                set_angle(i, lambert_angle(number));
            } else {
                choose_scatterer(i, number);
            }
        }
        for (std::size_t k = 0; k < walker_.scatterers().size(); ++k) scatter_by(k);
        look_at_angles();
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i] || is_on_ground(i)) continue;
            const Channels value = towards(i);
            const std::size_t hero = hero_of(i);
            value.store(one_packet_);
            const double inverse = scattering_.at(i, hero) / one_packet_[hero];
            packets_.weight.store(i, inverse * packets_.weight.load(i) * value);
            packets_.ratio.store(i, inverse * packets_.ratio.load(i) *
                                        zero_unless_positive(value, scattering_.load(i)));
        }
    }

    void set_angle(std::size_t i, const ScatteringAngle& angle) {
        one_minus_[i] = angle.one_minus;
        one_plus_[i] = angle.one_plus;
    }

    // Chooses what scatters by the first part of a number; what is left of it chooses the angle.
    void choose_scatterer(std::size_t i, double number) {
        const auto& scatterers = walker_.scatterers();
        const std::size_t hero = hero_of(i);
        double left = number * scattering_.at(i, hero);
        std::size_t chosen = 0;
        double part = 0;
        for (;; ++chosen) {
            part = density_[chosen][i] * data(scatterers[chosen].scattering_per_km)[hero];
            if (left < part || chosen + 1 == scatterers.size()) break;
            left -= part;
        }
        // Rounding may reach the end of a part, or its last one where that scatters nothing.
        constexpr double kLast = 1 - 0x1p-53;
        share_[i] = part > 0 ? std::min(left / part, kLast) : kLast;
        chosen_[i] = chosen;
    }

    // Chooses the angles of the paths that one of the scatterers scatters.
    void scatter_by(std::size_t scatterer) {
        const LayerPhase& phase = walker_.scatterers()[scatterer].phase;
        std::size_t paths[PathBatch::kPaths];
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (!ended_[i] && !is_on_ground(i) && chosen_[i] == scatterer) paths[count++] = i;
        }
        const PhaseFunction& of_all = phase.functions.front();
        if (!is_quadratic(of_all)) {
            for (std::size_t n = 0; n < count; ++n) {
                const std::size_t i = paths[n];
                set_angle(i, sample_phase(phase.of(hero_of(i)), share_[i],
                                          numbers_.random(number_of(i))));
            }
            return;
        }
        Column share{};
        Column cosine_minus, cosine_plus;
        for (std::size_t n = 0; n < count; ++n) share[n] = share_[paths[n]];
        for (std::size_t n = 0; n < count; n += kLanes) {
            const Angle<Lanes> angle =
                sample_quadratic(of_all.constant, of_all.quadratic, share.load(n));
            cosine_minus.store(n, angle.one_minus);
            cosine_plus.store(n, angle.one_plus);
        }
        for (std::size_t n = 0; n < count; ++n) {
            set_angle(paths[n], {cosine_minus[n], cosine_plus[n]});
        }
    }

    void turn() {
        numbers_.go_on();
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i]) continue;
            turns_[i] = numbers_.of(number_of(i));
            if (is_on_ground(i)) {
                columns_.direction.x[i] = columns_.up.x[i];
                columns_.direction.y[i] = columns_.up.y[i];
                columns_.direction.z[i] = columns_.up.z[i];
            }
        }
        for (std::size_t i = 0; i < count_; i += kLanes) {
            columns_.direction.store(
                i, scatter(columns_.direction.load(i), {one_minus_.load(i), one_plus_.load(i)},
                           turns_.load(i)));
        }
        remove_ended();
    }

    const PathWalker& walker_;
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

    // What stages hand to the next ones.
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

void WalkBatch(const PathWalker& walker, const PathSource& source, const PathRules& rules,
               PathBatch& batch) {
    Walk(walker, source, rules, batch).walk();
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(WalkBatch);

void walk_batch(const PathWalker& walker, const PathSource& source, const PathRules& rules,
                PathBatch& batch) {
    HWY_DYNAMIC_DISPATCH(WalkBatch)(walker, source, rules, batch);
}

}  // namespace skybake
#endif  // HWY_ONCE
