#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace relevo::viewer {

/// What a frame may cost.
struct BudgetLimits {
    std::optional<double> frame_ms;
    std::optional<std::uint64_t> triangles;

    bool any() const { return frame_ms || triangles; }
};

/// What a frame cost.
struct FrameCost {
    double ms = 0;
    std::uint64_t triangles = 0;
    double memory = 0;  ///< that it would have drawn with, over what there is for it
};

/// Chooses tau frame by frame so that frames keep to their limits: as fine as these allow, never finer than
/// the user's tau and never coarser than kCoarsestPx. The memory for the terrain is a limit always.
///
/// Works on ln tau. A frame's time is taken to be a + c T, T being its triangles, which go like tau^-p. a and
/// c are learnt from the frames themselves where their triangles differ enough to tell them apart; else a =
/// 0, which makes it slower and never unstable. Each frame goes a part of the way to the tau that the model
/// asks for, by a bounded step; the median of the last frames' costs keeps a single slow frame from being
/// seen. Aimed at is as much less than the limit as frames scatter, so that nearly all keep to it. A mesh
/// whose triangles alone tell that its frame will not need not be drawn (coarsen).
class FrameBudget {
  public:
    static constexpr double kCoarsestPx = 64;
    /// Aimed at: so much of the limit at most, so that a little noise stays below it.
    static constexpr double kAim = 0.9;

    /// \pre tau_px > 0
    FrameBudget(const BudgetLimits& limits, double tau_px);

    /// For the next frame.
    double tau_px() const;

    /// The user chose another tau: the next frames are not finer.
    void set_finest(double tau_px);

    /// Is a frame of so many triangles likely to exceed its time? Then tau_px() is coarser from now on, and
    /// the mesh better made anew before it is drawn.
    bool coarsen(std::uint64_t triangles);

    /// To be told what a frame cost that was drawn with tau_px().
    void add(const FrameCost& cost);

    /// Has tau come to rest: were the last steps below 1 %?
    bool at_rest() const { return small_steps_ >= 5; }

    /// Did a frame keep to the limits?
    bool holds(const FrameCost& cost) const;

  private:
    static constexpr int kRemembered = 3;
    struct Frame {
        double log_tau = 0;
        double log_load = 0;  // ln of its cost over what is aimed at
    };
    void learn(double frame_ms, double triangles);
    double ms_per_triangle() const;
    double expected_ms(double triangles) const;
    double aim() const;
    double wanted_step() const;
    void step(double by);

    BudgetLimits limits_;
    double finest_px_;
    double finest_;  // ln of it
    double log_tau_;
    std::array<Frame, kRemembered> time_{};
    double count_load_ = 0, memory_load_ = 0;  // ln, of the last frame; they have no noise
    std::uint64_t frames_ = 0;
    // Means over the last frames, for learning a and c.
    double mean_ms_ = 0, mean_triangles_ = 0, variance_ = 0, covariance_ = 0;
    double scatter2_ = 0;  // mean square of what frames took over what was expected, less 1
    int learnt_ = 0;
    int surprises_ = 0;     // one after the other
    double surprise2_ = 0;  // their part of the scatter, if it is one
    int small_steps_ = 0;
};

/// The finest tau, at least `finest_px` and at most FrameBudget::kCoarsestPx, whose mesh keeps to a number of
/// triangles, to 1 %; the coarsest where none does. \param triangles_at  falls with tau
template <class TrianglesAt>
double tau_for_triangles(std::uint64_t most, double finest_px, TrianglesAt&& triangles_at) {
    if (triangles_at(finest_px) <= most) return finest_px;
    double fine = finest_px;
    double coarse = finest_px < FrameBudget::kCoarsestPx ? FrameBudget::kCoarsestPx : finest_px;
    while (coarse > 1.01 * fine) {
        const double middle = std::sqrt(fine * coarse);
        (triangles_at(middle) <= most ? coarse : fine) = middle;
    }
    return coarse;
}

}  // namespace relevo::viewer
