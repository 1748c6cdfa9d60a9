// The flights of a batch of paths: how they begin, how far they go, and where they end. Names are those
// of tests/path_tracer/single_path.h.
#if defined(SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_FLIGHTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_FLIGHTS_INL_H_
#undef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_FLIGHTS_INL_H_
#else
#define SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_FLIGHTS_INL_H_
#endif

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/light/path_tracer/path_state-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

class PathFlights : public PathState {
  public:
    using PathState::PathState;

  protected:
    // --- Begins ---

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

    void set_flight(std::size_t i, const PathMedium::Flight& flight) {
        columns_.s_km[i] = flight.s_km;
        columns_.falls[i] = flight.falls ? 1 : 0;
        columns_.hits_ground[i] = flight.hits_ground ? 1 : 0;
        columns_.lowest_shell[i] = static_cast<double>(flight.lowest_shell);
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
        const Channels albedo(medium_.sky().air.ground_albedo);
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

    // --- Ends ---

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
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_LIGHT_PATH_TRACER_PATH_FLIGHTS_INL_H_
