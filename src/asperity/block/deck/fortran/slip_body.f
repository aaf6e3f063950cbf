C
      SUBROUTINE ASPSLP(G,DYB,ETA,D1,D2,E1,E2)
C     The slip in two parts, body vibrated. Part 1 is the motion along
C     the drive, part 2 the share ETA of the motion across it.
C     E1, E2: derivatives of the parts by the slip G, axis by axis.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION G(2),D1(2),D2(2),E1(2),E2(2)
      D1(1) = G(1)
      D1(2) = 0.D0
      D2(1) = 0.D0
      D2(2) = ETA*G(2)
      E1(1) = 1.D0
      E1(2) = 0.D0
      E2(1) = 0.D0
      E2(2) = ETA
      RETURN
      END
