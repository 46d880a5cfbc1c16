# A pendulum in Cartesian coordinates, index 2 here: positions x, z, velocities v, w, the tension T of the rod.
import courant

def pendulum(t, y, yp):
    x, z, v, w, T = y
    return [yp[0] - v, yp[1] - w, yp[2] + T*x, yp[3] + T*z + 1, x*x + z*z - 1]

sol = courant.solve_dae(pendulum, (0, 20), [0.6, -0.8, 0.8, 0.6, 0], step=0.02)
print(sol.ladder)
print("length:", abs(sol.y[0]**2 + sol.y[1]**2 - 1).max())
