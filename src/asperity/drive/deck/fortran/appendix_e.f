      SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP,DSLIP,SED,SFD,
     1 DDTDDT,PNEWDT,STATEV,DGAM,TAULM,PRESS,DPRESS,DDPDDH,SLIP,
     2 KSTEP,KINC,TIME,DTIME,NOEL,CINAME,SLNAME,MSNAME,NPT,NODE,
     3 NPATCH,COORDS,RCOORD,DROT,TEMP,PREDEF,NFDIR,MCRD,NPRED,
     4 NSTATV,CHRLNGTH,PROPS,NPROPS)
C
      INCLUDE 'ABA_PARAM.INC'
C
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION TAU(NFDIR),DDTDDG(NFDIR,NFDIR),DDTDDP(NFDIR),
     1 DSLIP(NFDIR),DDTDDT(NFDIR,2),STATEV(*),DGAM(NFDIR),
     2 TAULM(NFDIR),SLIP(NFDIR),TIME(2),COORDS(MCRD),
     3 RCOORD(MCRD),DROT(2,2),TEMP(2),PREDEF(2,*),PROPS(NPROPS)
C
      DIMENSION G(2),E(2),DE(2,2),DC(2),DA(2),DQ(2),DSI(2),DS1(2)
      PARAMETER (ZERO=0.D0,ONE=1.D0)
C
      XMU = PROPS(1)
      XI = PROPS(2)
      SMAX = PROPS(3)
C
      IF (LM.EQ.2) RETURN
      LM = 0
C
C     No pressure: the way slid is counted anew; the root stays.
      IF (PRESS.LE.ZERO) THEN
        STATEV(1) = ZERO
        STATEV(2) = ZERO
        DO 20 I = 1,2
          TAU(I) = ZERO
          DDTDDP(I) = ZERO
          DSLIP(I) = ZERO
          DO 10 J = 1,2
            DDTDDG(I,J) = ZERO
   10     CONTINUE
   20   CONTINUE
        RETURN
      END IF
C
C     First phase, (79) to (83): along the first axis.
      G(1) = STATEV(1)+DGAM(1)
      G(2) = STATEV(2)+DGAM(2)
      X = G(1)-STATEV(3)
      Y = STATEV(2)-STATEV(4)
      S = STATEV(5)
      R = SQRT(X*X+Y*Y)
      CA = ONE
      SA = ZERO
      DCA = ZERO
      DSA = ZERO
      IF (R.GT.ZERO) THEN
        CA = X/R
        SA = Y/R
        DCA = SA*SA/R
        DSA = -SA*CA/R
      END IF
      CALL APPALG(S,R,XI,SMAX,SI,SIR,SIS)
      DSI(1) = SIR*CA
      DSI(2) = ZERO
C
C     Second phase, (84) to (90) without ETA: along the second axis.
      C = SI*CA
      A = DGAM(2)+SI*SA
      DC(1) = DSI(1)*CA+SI*DCA
      DC(2) = ZERO
      DA(1) = DSI(1)*SA+SI*DSA
      DA(2) = ONE
      Q = SQRT(C*C+A*A)
      E(1) = ONE
      E(2) = ZERO
      IF (Q.GT.ZERO) THEN
        E(1) = C/Q
        E(2) = A/Q
      END IF
      CALL APPALG(SI,Q,XI,SMAX,S1,S1Q,S1S)
      DO 30 J = 1,2
        DQ(J) = E(1)*DC(J)+E(2)*DA(J)
        DE(1,J) = ZERO
        DE(2,J) = ZERO
        IF (Q.GT.ZERO) THEN
          DE(1,J) = (DC(J)-E(1)*DQ(J))/Q
          DE(2,J) = (DA(J)-E(2)*DQ(J))/Q
        END IF
        DS1(J) = S1Q*DQ(J)+S1S*DSI(J)
   30 CONTINUE
C
      STIFF = XMU*PRESS/SMAX
      IF (ABS(S1).LT.SMAX) THEN
C       Behaviour remains elastic.
        DO 50 I = 1,2
          TAU(I) = STIFF*S1*E(I)
          DDTDDP(I) = XMU*S1*E(I)/SMAX
          DO 40 J = 1,2
            DDTDDG(I,J) = STIFF*(E(I)*DS1(J)+S1*DE(I,J))
   40     CONTINUE
          DSLIP(I) = DGAM(I)-(S1*E(I)-(STATEV(I)-STATEV(I+2)))
   50   CONTINUE
        STATEV(3) = G(1)-S1*E(1)
        STATEV(4) = G(2)-S1*E(2)
        STATEV(5) = S1
      ELSE
C       Behaviour is plastic: root and deflection stay where they were.
        DO 70 I = 1,2
          TAU(I) = XMU*PRESS*E(I)
          DDTDDP(I) = XMU*E(I)
          DO 60 J = 1,2
            DDTDDG(I,J) = XMU*PRESS*DE(I,J)
   60     CONTINUE
          DSLIP(I) = DGAM(I)
   70   CONTINUE
      END IF
      STATEV(1) = G(1)
      STATEV(2) = G(2)
      RETURN
      END
C
      SUBROUTINE APPALG(SIZE,REACH,XI,SMAX,END,ENDR,ENDS)
C     Size of the deflection after its tip moved from SIZE to REACH, by
C     Dahl's explicit step; its derivatives by REACH and by SIZE.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      WAY = REACH-SIZE
      SGN = SIGN(1.D0,WAY)
      REST = 1.D0-SIZE*SGN/SMAX
      IF (XI.EQ.1.D0) THEN
        ENDR = REST
        SLOPE = 1.D0
      ELSE
C       Beyond the limit a power of a negative number has no value.
        REST = MAX(REST,0.D0)
        ENDR = REST**XI
        SLOPE = 0.D0
        IF (REST.GT.0.D0) SLOPE = XI*REST**(XI-1.D0)
      END IF
      END = SIZE+WAY*ENDR
      ENDS = 1.D0-ENDR-WAY*SLOPE*SGN/SMAX
      RETURN
      END
