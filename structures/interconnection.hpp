// Interconnection: systems that are joined at their ports.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "courant/structures/port_system.hpp"

namespace courant {

// What p ports have in common: p equations of their inputs u and outputs y,
//
//   F u + E y = s(t, y)
//
// Where s = 0, (u, y) lies in the Dirac structure {F u + E y = 0} ⊂ Rᵖ ⊕ Rᵖ*, so that the joint
// neither makes nor takes power, Σ u_a y_a = 0. A source is one port whose input is given.
class Joint {
 public:
  // A formula of t and the outputs of all ports of the interconnection, in their order.
  using Source = std::function<Expr(const Expr& t, const ExprVector& y)>;

  // Ports are numbered through all systems, in their order. F, E: p × p. Throws
  // std::invalid_argument unless F Eᵀ + E Fᵀ = 0 and [F E] has rank p, up to 1e-12 of their entries,
  // or if a port is there twice.
  Joint(std::vector<Index> ports, MatrixXd F, MatrixXd E);
  // u₁ = … = u_p, Σ y = 0.
  static Joint shared_input(std::vector<Index> ports);
  // y₁ = … = y_p, Σ u = 0.
  static Joint shared_output(std::vector<Index> ports);
  // u = K y with a skew-symmetric K.
  static Joint gyrator(std::vector<Index> ports, const MatrixXd& K);
  // u_port = s(t, y).
  static Joint source(Index port, Source s);

  const std::vector<Index>& ports() const { return ports_; }
  // p equations, where u and y are those of all ports.
  ExprVector equations(const Expr& t, const ExprVector& u, const ExprVector& y) const;

 private:
  std::vector<Index> ports_;
  MatrixXd F_, E_;
  Source source_;
};

// The systems side by side on the product of their manifolds, with the sum of their energies, the unknowns of
// each and all of their ports, in their order. Ports of joints obey these. A port without a joint stays
// as it is in its system, and is free if it is there: so an interconnection can be joined on.
//
// The equations of the parts come first, of each as many as its tangent vectors have entries, then the others
// of each; after them one for each port: that of its system, or in its place one of its joint. In the names of
// the whole those of each part begin with its name.
class Interconnection final : public PortSystem {
 public:
  struct Part {
    std::string name;
    std::shared_ptr<const PortSystem> system;
  };
  // Throws std::invalid_argument if a system is null, or a port does not exist, belongs to two joints or
  // is not free.
  Interconnection(std::vector<Part> parts, std::vector<Joint> joints);
  ~Interconnection() override;

  const std::vector<Part>& parts() const { return parts_; }
  Index tangent_blocks() const override;

 private:
  struct Layout;  // where the entries of each part are
  Interconnection(std::vector<Part> parts, std::vector<Joint> joints,
                  std::shared_ptr<const Layout> layout);
  Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override;
  bool do_is_free(Index port) const override;
  ExprVector do_output(const ExprVector& x, const ExprVector& alpha,
                       const ExprVector& z) const override;
  ExprVector do_inner_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                const ExprVector& z, const Expr& t) const override;
  ExprVector do_port_equations(const Expr& t, const ExprVector& u,
                               const ExprVector& y) const override;
  Powers do_inner_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                         const ExprVector& z, const Expr& t) const override;

  std::vector<Part> parts_;
  std::vector<Joint> joints_;
  std::shared_ptr<const Layout> layout_;
};

}  // namespace courant
