#include "courant/structures/elements/domain.hpp"

namespace courant::elements::domains {

const Domain electrical{"electrical", "i_", "v_", "potential_"};
const Domain translation{"translational", "F_", "v_", "velocity_"};
const Domain rotation{"rotational", "tau_", "omega_", "speed_"};
const Domain hydraulic{"hydraulic", "Q_", "P_", "pressure_"};
const Domain thermal{"thermal", "s_", "T_", "temperature_"};

}  // namespace courant::elements::domains
