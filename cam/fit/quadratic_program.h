// SPDX-License-Identifier: Apache-2.0
// The dual active-set method of Goldfarb and Idnani (Mathematical Programming 27, 1983): the minimum of
// x'Gx/2 + g'x under linear constraints, which may be added one after the other. In: a positive definite G,
// constraints. Out: the minimum, or the constraints that contradict each other. Called by fit.cpp.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace rung::cam {

class QuadraticProgram {
 public:
  // False: G is not positive definite.
  [[nodiscard]] bool start(const Eigen::MatrixXd& G, const Eigen::VectorXd& g);

  // normal'x = bound, or normal'x >= bound. `label` names it in conflict(). False: it contradicts the others.
  [[nodiscard]] bool addEqual(const Eigen::VectorXd& normal, double bound, int label);
  [[nodiscard]] bool addAtLeast(const Eigen::VectorXd& normal, double bound, int label);

  const Eigen::VectorXd& x() const { return x_; }
  int iterations() const { return iterations_; }
  // After false: the labels of the constraints that exclude the last one.
  const std::vector<int>& conflict() const { return conflict_; }

 private:
  struct Active {
    double multiplier;
    bool is_equality;
    int label;
  };
  bool add(const Eigen::VectorXd& normal, double bound, bool is_equality, int label);
  void insert(Eigen::VectorXd& d);
  void drop(Eigen::Index at);

  Eigen::MatrixXd J_, R_;
  Eigen::VectorXd x_;
  std::vector<Active> active_;
  std::vector<int> conflict_;
  int iterations_ = 0;
};

}  // namespace rung::cam
