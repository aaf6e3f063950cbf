C
      SUBROUTINE ASPLAW(S,D1,D2,E1,E2,XI,ONESID,T)
C     Dahl's law with the relaxation along the slip, exact for a slip of
C     constant direction; everything over SMAX.
C     S(1), S(2): deflection, changed from start to end of increment;
C     S(3): its size.
C     D1, D2: the slip, in two parts; E1, E2: derivatives by the slip.
C     T(I,J): derivative of S(I) by the slip along axis J.
C     ONESID is not used: this law knows no forced direction.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(3),D1(2),D2(2),E1(2),E2(2),T(2,2),D(2),E(2),W(2),
     1 Q(2)
      LOGICAL ONESID
      PARAMETER (TINY=1.D-150)
C
      D(1) = D1(1)+D2(1)
      D(2) = D1(2)+D2(2)
      SLEN = SQRT(D(1)**2+D(2)**2)
      IF (SLEN.LE.TINY) THEN
C       No slip, no direction: the elastic answer.
        DO 10 J = 1,2
          S(J) = S(J)+D(J)
          T(1,J) = 0.D0
          T(2,J) = 0.D0
          T(J,J) = E1(J)+E2(J)
   10   CONTINUE
        S(3) = SQRT(S(1)**2+S(2)**2)
        RETURN
      END IF
C
C     W: what is missing to the deflection in steady sliding along D.
      E(1) = D(1)/SLEN
      E(2) = D(2)/SLEN
      W(1) = E(1)-S(1)
      W(2) = E(2)-S(2)
      RHO = SQRT(W(1)**2+W(2)**2)
C
C     TURN = (1-g)/L, SPEED and BEND as in
C     T = TURN P + SPEED W E' - BEND W (P W)',  P = I - E E'.
      BEND = 0.D0
      IF (XI.EQ.1.D0) THEN
        CALL ASPREL(SLEN,SPEED,TURN,DUMMY)
        S(1) = S(1)*SPEED+D(1)*TURN
        S(2) = S(2)*SPEED+D(2)*TURN
      ELSE IF (RHO.LE.TINY) THEN
        SPEED = 0.D0
        TURN = 1.D0/SLEN
        S(1) = E(1)
        S(2) = E(2)
      ELSE
        PART = (1.D0-XI)*RHO**(XI-1.D0)
        BASE = 1.D0-PART*SLEN
        SPEED = 0.D0
        TURN = 1.D0/SLEN
        REST = 0.D0
        IF (BASE.GT.0.D0) THEN
          REST = BASE**(1.D0/(1.D0-XI))
          SPEED = REST/BASE*RHO**(XI-1.D0)
          TURN = -ASPEM1(ASPL1P(-PART*SLEN)/(1.D0-XI))/SLEN
          BEND = REST*PART/(BASE*RHO*RHO)
        END IF
        S(1) = E(1)-REST*W(1)
        S(2) = E(2)-REST*W(2)
      END IF
      S(3) = SQRT(S(1)**2+S(2)**2)
C
      ALONG = E(1)*W(1)+E(2)*W(2)
      Q(1) = W(1)-E(1)*ALONG
      Q(2) = W(2)-E(2)*ALONG
      DO 30 J = 1,2
        DO 20 I = 1,2
          T(I,J) = SPEED*W(I)*E(J)-BEND*W(I)*Q(J)-TURN*E(I)*E(J)
          IF (I.EQ.J) T(I,J) = T(I,J)+TURN
          T(I,J) = T(I,J)*(E1(J)+E2(J))
   20   CONTINUE
   30 CONTINUE
      RETURN
      END
