#!/usr/bin/env python3
"""The numbers of RandomNumbers by the algorithms of the C++ standard ([rand.util.seedseq], [rand.eng.mers]), written anew."""


def seed_seq(seeds, n):
    v, s, mask = [0x8b8b8b8b]*n, len(seeds), 0xffffffff
    t = 11 if n >= 623 else 7 if n >= 68 else 5 if n >= 39 else 3 if n >= 7 else (n - 1)//2
    p = (n - t)//2
    q, m = p + t, max(s + 1, n)

    def T(x):
        return x ^ (x >> 27)
    for k in range(m):
        r1 = 1664525*T(v[k % n] ^ v[(k + p) % n] ^ v[(k - 1) % n]) & mask
        r2 = (r1 + (s if k == 0 else k % n + seeds[k - 1] if k <= s else k % n)) & mask
        v[(k + p) % n] = (v[(k + p) % n] + r1) & mask
        v[(k + q) % n] = (v[(k + q) % n] + r2) & mask
        v[k % n] = r2
    for k in range(m, m + n):
        r3 = 1566083941*T((v[k % n] + v[(k + p) % n] + v[(k - 1) % n]) & mask) & mask
        r4 = (r3 - k % n) & mask
        v[(k + p) % n] ^= r3
        v[(k + q) % n] ^= r4
        v[k % n] = r4
    return v


def words(seed, name, number):
    n, m, r, mask = 312, 156, 31, 2**64 - 1
    a = seed_seq([seed & 0xffffffff, seed >> 32, number & 0xffffffff, number >> 32, *name.encode()], 2*n)
    x = [a[2*i] + (a[2*i + 1] << 32) for i in range(n)]
    if x[0] >> r == 0 and not any(x[1:]):
        x[0] = 1 << 63
    i = 0
    while True:
        y = (x[i] >> r << r) | (x[(i + 1) % n] & (2**r - 1))
        x[i] = x[(i + m) % n] ^ (y >> 1) ^ (0xb5026f5aa96619e9 if y & 1 else 0)
        z = x[i]
        z ^= (z >> 29) & 0x5555555555555555
        z ^= (z << 17) & 0x71d67fffeda60000 & mask
        z ^= (z << 37) & 0xfff7eee000000000 & mask
        yield z ^ (z >> 43)
        i = (i + 1) % n


def normal(seed, name, number):
    w = words(seed, name, number)

    def uniform():
        return (next(w) >> 11)*2.0**-53

    def happens_within(a):
        count, last, u = 0, a, uniform()
        while u < last:
            count, last, u = count + 1, u, uniform()
        return count % 2 == 0

    def happens(a):
        while a > 1:
            if not happens_within(1.0):
                return False
            a -= 1
        return happens_within(a)
    while True:
        whole = 0.0
        while True:
            u = uniform()
            if happens_within(u):
                break
            whole += 1
        size = whole + u
        kept = happens((size - 1)*(size - 1)*0.5)
        positive = next(w) >> 63 == 0
        if kept:
            return size if positive else -size


if __name__ == "__main__":
    for number in (0, 1):
        print("uniform(1, u, %d)" % number, (next(words(1, "u", number)) >> 11)*2.0**-53)
    for arguments in ((1, "g", 0), (1, "g", 1), (2**40 + 5, "noise", 999)):
        print("normal", arguments, normal(*arguments))
