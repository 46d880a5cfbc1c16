# A disk that rolls upright on a plane: contact (x, y), heading, turn; its radius is 1, and the contact does not slip.
import courant
import numpy as np

def no_slip(q, v):
    return [v[0] - v[3]*np.cos(q[2]), v[1] - v[3]*np.sin(q[2])]

sol = courant.solve_lagrangian(lambda q, v: (v**2) @ [0.5, 0.5, 0.125, 0.25], (0, 6.28), [0, 0, 0, 0], [1, 0, 1, 1], nonholonomic=no_slip, step=0.01)
print(sol.ladder)
print("circle:", abs(np.hypot(sol["q"][0], sol["q"][1] - 1) - 1).max())
