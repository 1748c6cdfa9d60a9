// The texels whose trilinear lookups come nearest to values at places that are finer than the texels,
// where it shows.
//
// Point samples of a rough function, or means of it, make poor texels: lookups between them miss its
// peaks. The texels t here are those of least squares: with the weights A of lookups and a weight w for
// each place,
//
//   sum over places of w (shown(A t) - shown(value))^2 is least
//
// Optical depths are shown as sunlight: within a cloud a depth of 30 for one of 40 is nothing, and at its
// edge 1 for 0 is most of the sun. Such texels are found in steps, each with the slopes of those before
// (Levenberg 1944), and the texels of a step by conjugate gradients (Hestenes and Stiefel 1952). A texel
// that no place of any weight looks up is the value at its centre.
//
// Beside jumps such a fit overshoots. `bounds` are what the values can be by their nature, and texels
// beyond them are set to the nearest bound.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace skybake::cloud_light {

enum class ShownAs { itself, sunlight };

// Places i at (i + 1/2) / places and texels j at (j + 1/2) / texels of each axis. There are at least as
// many places as texels. Both are x fastest; x and y repeat.
class TexelFit {
  public:
    // `weights` has one for each place, 0 or more.
    TexelFit(const std::array<int, 3>& places, const std::array<int, 3>& texels,
             std::vector<float> weights, int threads);

    // Is told which share of a fit is done; false ends it early, and its texels are not to be used.
    using Watch = std::function<bool(double)>;

    std::vector<float> fit(
        const std::vector<float>& values, ShownAs shown, const std::array<float, 2>& bounds,
        const Watch& goes_on = [](double) { return true; }) const;

  private:
    using Texels = std::vector<double>;
    // A place is looked up between the texels low, from -1, and low + 1.
    struct Lookup {
        int low = 0;
        float share = 0;  // of the texel low + 1
    };
    struct Run {  // places of a row, all of which have a weight
        int y = 0;
        int first = 0;
        int last = 0;  // behind them
    };
    // What a step knows of the texels before it.
    struct Misses {
        std::vector<float> weights;  // w slope^2; empty: those of places
        Texels sums;                 // A^T of w slope (shown(value) - shown(A t))
        double squares = 0;
    };

    void find_runs();
    std::array<std::size_t, 2> rows_of(std::size_t axis, int place) const;
    Texels centers(const std::vector<float>& values) const;
    Misses misses(const Texels& texels, const std::vector<float>& values, ShownAs shown) const;
    Texels step(const Misses& misses, const Watch& goes_on) const;
    // Return the sums over places of what `term` makes of each place's lookup, in shares of texels.
    template <class Term>
    Texels gathered(const Texels& texels, const Term& term) const;
    template <class Term>
    void gather_run(const Texels& texels, int z, const Run& run, const Term& term,
                    std::vector<float>& plane) const;

    std::array<int, 3> places_;
    std::array<int, 3> size_;
    std::vector<float> weights_;
    int threads_;
    std::array<std::vector<Lookup>, 3> lookups_;
    std::vector<std::vector<Run>> runs_;  // of each plane of places
};

}  // namespace skybake::cloud_light
