// SPDX-License-Identifier: Apache-2.0
// Goldfarb and Idnani's method; see quadratic_program.h. The names J, R, d, z, r, t are those of the paper: R is the
// triangle of the active normals in the basis J.
#include "cam/fit/quadratic_program.h"

#include <cmath>
#include <limits>

namespace rung::cam {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kDependent = 1e-11;  // relative: a normal in the span of the active ones
constexpr int kMostSteps = 20000;

void rotateColumns(Eigen::MatrixXd& matrix, Index a, Index b, double c, double s) {
  for (Index i = 0; i < matrix.rows(); ++i) {
    const double at_a = matrix(i, a), at_b = matrix(i, b);
    matrix(i, a) = c * at_a + s * at_b;
    matrix(i, b) = c * at_b - s * at_a;
  }
}

}  // namespace

bool QuadraticProgram::start(const Eigen::MatrixXd& G, const VectorXd& g) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(G);
  if (cholesky.info() != Eigen::Success) return false;
  x_ = -cholesky.solve(g);
  J_ = Eigen::MatrixXd::Identity(G.rows(), G.rows());
  cholesky.matrixU().solveInPlace(J_);
  R_ = Eigen::MatrixXd::Zero(G.rows(), G.rows());
  active_.clear();
  conflict_.clear();
  iterations_ = 0;
  return x_.allFinite();
}

bool QuadraticProgram::addEqual(const VectorXd& normal, double bound, int label) {
  return add(normal, bound, true, label);
}

bool QuadraticProgram::addAtLeast(const VectorXd& normal, double bound, int label) {
  return normal.dot(x_) >= bound || add(normal, bound, false, label);
}

bool QuadraticProgram::add(const VectorXd& normal, double bound, bool is_equality, int label) {
  double multiplier = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    ++iterations_;
    const Index q = static_cast<Index>(active_.size()), n = x_.size();
    VectorXd d = J_.transpose() * normal;
    const VectorXd z = J_.rightCols(n - q) * d.tail(n - q);
    const VectorXd r = R_.topLeftCorner(q, q).triangularView<Eigen::Upper>().solve(d.head(q));
    const double slack = normal.dot(x_) - bound;

    double partial = kInfinite;  // the step after which an active constraint leaves
    Index leaving = -1;
    const double sign = is_equality && slack > 0 ? -1 : 1;
    for (Index i = 0; i < q; ++i) {
      if (active_[static_cast<size_t>(i)].is_equality || sign * r[i] <= 0) continue;
      const double at = active_[static_cast<size_t>(i)].multiplier / (sign * r[i]);
      if (at < partial) partial = at, leaving = i;
    }
    const bool is_dependent = q == n || d.tail(n - q).norm() <= kDependent * d.norm();
    const double full = is_dependent ? kInfinite : -slack / z.dot(normal);
    if (is_dependent && is_equality && std::fabs(slack) <= kDependent * (1 + std::fabs(bound))) return true;
    const double length = std::min(partial, std::fabs(full));
    if (length == kInfinite) {
      conflict_.clear();
      for (Index i = 0; i < q; ++i)
        if (std::fabs(r[i]) > 1e-9 * r.cwiseAbs().maxCoeff())
          conflict_.push_back(active_[static_cast<size_t>(i)].label);
      return false;
    }
    const double t = sign * length;
    if (!is_dependent) x_ += t * z;
    for (Index i = 0; i < q; ++i) active_[static_cast<size_t>(i)].multiplier -= t * r[i];
    multiplier += t;
    if (!is_dependent && std::fabs(full) <= partial) {
      insert(d);
      active_.push_back({multiplier, is_equality, label});
      return true;
    }
    drop(leaving);
  }
  conflict_.clear();
  return false;
}

// Rotates J so that the new normal has one component outside of the active ones.
void QuadraticProgram::insert(VectorXd& d) {
  const Index q = static_cast<Index>(active_.size());
  for (Index i = d.size() - 1; i > q; --i) {
    const double length = std::hypot(d[i - 1], d[i]);
    if (d[i] == 0 || length == 0) continue;
    const double c = d[i - 1] / length, s = d[i] / length;
    d[i - 1] = length;
    d[i] = 0;
    rotateColumns(J_, i - 1, i, c, s);
  }
  R_.col(q).head(q + 1) = d.head(q + 1);
}

void QuadraticProgram::drop(Index at) {
  const Index q = static_cast<Index>(active_.size());
  for (Index column = at; column + 1 < q; ++column) {
    R_.col(column).head(column + 2) = R_.col(column + 1).head(column + 2);
    const double length = std::hypot(R_(column, column), R_(column + 1, column));
    if (length == 0) continue;
    const double c = R_(column, column) / length, s = R_(column + 1, column) / length;
    R_(column, column) = length;
    R_(column + 1, column) = 0;
    for (Index other = column + 1; other + 1 < q; ++other) {
      const double a = R_(column, other + 1), b = R_(column + 1, other + 1);
      R_(column, other + 1) = c * a + s * b;
      R_(column + 1, other + 1) = c * b - s * a;
    }
    rotateColumns(J_, column, column + 1, c, s);
  }
  R_.col(q - 1).setZero();
  active_.erase(active_.begin() + at);
}

}  // namespace rung::cam
