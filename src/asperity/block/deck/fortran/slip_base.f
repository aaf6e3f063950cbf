C
      SUBROUTINE ASPSLP(G,DYB,ETA,D1,D2,E1,E2)
C     The slip in two parts, base vibrated. G is the body's motion less
C     the base's. Part 1 is the body's motion with the base's motion
C     along the drive in it; part 2 is the share ETA of the base's
C     motion across the drive, DYB, that reaches the contact.
C     E1, E2: derivatives of the parts by G, axis by axis.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION G(2),D1(2),D2(2),E1(2),E2(2)
      D1(1) = G(1)
      D1(2) = G(2)+DYB
      D2(1) = 0.D0
      D2(2) = -ETA*DYB
      E1(1) = 1.D0
      E1(2) = 1.D0
      E2(1) = 0.D0
      E2(2) = 0.D0
      RETURN
      END
