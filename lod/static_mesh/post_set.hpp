#pragma once

#include <atomic>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

/// A set of posts of a grid, one bit each. Any threads may add and ask at the same time; rows of bits begin
/// at words of their own.
class PostSet {
  public:
    PostSet(int columns, int rows)
        : words_a_row_((static_cast<std::size_t>(columns) + 63) / 64),
          words_(words_a_row_ * static_cast<std::size_t>(rows)) {}

    static std::uint64_t memory_bytes(std::uint64_t columns, std::uint64_t rows) {
        return (columns + 63) / 64 * rows * sizeof(std::uint64_t);
    }

    bool contains(const GridPoint& p) const {
        return (words_[word(p)].load(std::memory_order_relaxed) & bit(p)) != 0;
    }

    /// True where the post is new to the set: for one caller only.
    bool add(const GridPoint& p) {
        std::atomic<std::uint64_t>& w = words_[word(p)];
        if ((w.load(std::memory_order_relaxed) & bit(p)) != 0) return false;
        return (w.fetch_or(bit(p), std::memory_order_relaxed) & bit(p)) == 0;
    }

    /// Sets the 64 posts of a row from one whose column is a multiple of 64, for one caller only.
    void set_word(const GridPoint& p, std::uint64_t bits) {
        words_[word(p)].store(bits, std::memory_order_relaxed);
    }

    /// Has the set any, and has it all, of the posts [first, last] of a row?
    struct Share {
        bool any = false;
        bool all = true;
    };
    Share share(int row, int first, int last) const {
        Share share;
        const std::size_t start = static_cast<std::size_t>(row) * words_a_row_;
        for (int w = first / 64; w <= last / 64; ++w) {
            std::uint64_t mask = ~std::uint64_t{0};
            if (w == first / 64) mask &= ~std::uint64_t{0} << (first % 64);
            if (w == last / 64) mask &= ~std::uint64_t{0} >> (63 - last % 64);
            const std::uint64_t bits =
                words_[start + static_cast<std::size_t>(w)].load(std::memory_order_relaxed) & mask;
            share.any = share.any || bits != 0;
            share.all = share.all && bits == mask;
        }
        return share;
    }

    /// Calls visit(column) for the posts of a row, from the west.
    template <class Visit>
    void for_each_in_row(int row, Visit visit) const {
        const std::size_t start = static_cast<std::size_t>(row) * words_a_row_;
        for (std::size_t w = 0; w < words_a_row_; ++w) {
            std::uint64_t bits = words_[start + w].load(std::memory_order_relaxed);
            for (; bits != 0; bits &= bits - 1) visit(static_cast<int>(64 * w) + std::countr_zero(bits));
        }
    }

    std::size_t words() const { return words_.size(); }
    int count_in_word(std::size_t w) const {
        return std::popcount(words_[w].load(std::memory_order_relaxed));
    }
    std::size_t word(const GridPoint& p) const {
        assert(p.column >= 0 && p.row >= 0);
        return static_cast<std::size_t>(p.row) * words_a_row_ + static_cast<std::size_t>(p.column) / 64;
    }
    /// Posts of the set in the post's word that are before it.
    int count_before(const GridPoint& p) const {
        return std::popcount(words_[word(p)].load(std::memory_order_relaxed) & (bit(p) - 1));
    }

  private:
    static std::uint64_t bit(const GridPoint& p) { return std::uint64_t{1} << (p.column % 64); }

    std::size_t words_a_row_;
    std::vector<std::atomic<std::uint64_t>> words_;
};

/// The place of each post of a set in the set's order, row by row.
class PostNumbers {
  public:
    /// \pre the set does not change any more
    explicit PostNumbers(const PostSet& posts) : posts_(posts), before_(posts.words()) {
        for (std::size_t w = 0; w < before_.size(); ++w) {
            before_[w] = static_cast<std::uint32_t>(count_);
            count_ += static_cast<std::uint64_t>(posts.count_in_word(w));
        }
    }

    static std::uint64_t memory_bytes(std::uint64_t columns, std::uint64_t rows) {
        return (columns + 63) / 64 * rows * sizeof(std::uint32_t);
    }

    std::uint64_t count() const { return count_; }

    /// \pre the post is in the set, and count() is at most 2^32
    std::uint32_t of(const GridPoint& p) const {
        return before_[posts_.word(p)] + static_cast<std::uint32_t>(posts_.count_before(p));
    }

  private:
    const PostSet& posts_;
    std::vector<std::uint32_t> before_;  // by word
    std::uint64_t count_ = 0;
};

}  // namespace relevo::lod
