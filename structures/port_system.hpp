// PortSystem: an energy system with ports, where others can be joined to it.
#pragma once

#include <string>
#include <vector>

#include "courant/structures/energy_system.hpp"

namespace courant {

// Each of m ports has an input u_a, one of the auxiliary unknowns z, and an output y_a(x, α, z); what
// enters by it is the power y_a u_a. The equations are those of the system, whatever its ports are joined
// to, and m of the ports alone:
//
//   inner(x, v, α, z, t) = 0,   relation(t, u, y) = 0
//
// A port is free if relation a says that it is closed, 0 = y_a, and no other says anything of it: a joint may say
// something else in its place. To subclass: as EnergySystem, with the functions below in the place of do_equations and
// do_powers.
class PortSystem : public EnergySystem {
 public:
  Index port_count() const { return static_cast<Index>(inputs_.size()); }  // m
  // Where the inputs are in z.
  const std::vector<Index>& inputs() const { return inputs_; }
  bool is_free(Index port) const { return do_is_free(port); }

  // y, size m; α = d_xE(x, t) but for a discrete gradient.
  ExprVector output(const ExprVector& x, const ExprVector& alpha, const ExprVector& z) const {
    return do_output(x, alpha, z);
  }
  // Size equation_count() - m.
  ExprVector inner_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                             const ExprVector& z, const Expr& t) const {
    return do_inner_equations(x, v, alpha, z, t);
  }
  // Size m.
  ExprVector port_equations(const Expr& t, const ExprVector& u, const ExprVector& y) const {
    return do_port_equations(t, u, y);
  }
  // What is supplied and dissipated inside, not by the ports.
  Powers inner_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                      const ExprVector& z, const Expr& t) const {
    return do_inner_powers(x, v, alpha, z, t);
  }

 protected:
  PortSystem(std::shared_ptr<const Manifold> manifold, Index auxiliary_size, Index equation_count,
             Names names, std::vector<Index> inputs)
      : EnergySystem(std::move(manifold), auxiliary_size, equation_count, std::move(names)),
        inputs_(std::move(inputs)) {}

 private:
  ExprVector do_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                          const ExprVector& z, const Expr& t, const ExprVector& y,
                          const Expr& s) const final;
  Powers do_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                   const ExprVector& z, const Expr& t) const final;

  // To subclass, override:
  virtual bool do_is_free(Index port) const = 0;
  virtual ExprVector do_output(const ExprVector& x, const ExprVector& alpha,
                               const ExprVector& z) const = 0;
  virtual ExprVector do_inner_equations(const ExprVector& x, const ExprVector& v,
                                        const ExprVector& alpha, const ExprVector& z,
                                        const Expr& t) const = 0;
  virtual ExprVector do_port_equations(const Expr& t, const ExprVector& u,
                                       const ExprVector& y) const = 0;
  virtual Powers do_inner_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                 const ExprVector& z, const Expr& t) const = 0;

  std::vector<Index> inputs_;
};

}  // namespace courant
